// Where light starts: suns, lamps and sky on the receivers.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/random.h"
#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/sequence.h"

namespace daylit {
namespace {

constexpr int kSunSamples = 4;
constexpr int kLampSamples = 2;     // per lamp, where few lamps reach
constexpr std::size_t kFewLamps = 8;
constexpr int kManyLampSamples = 16;  // in all, where many do
constexpr int kSkyRows = 32, kSkyColumns = 64;
constexpr std::uint64_t kLampStream = 1, kSunStream = 2;  // apart from the gather's stream 0

struct Place {
    Vec3 position, normal;
};

/// The usable points of a receiver.
class UsablePoints {
  public:
    UsablePoints(const GatherScene& scene, const GatherHits& hits, std::size_t receiver) {
        const Receiver r = hits.receivers[receiver];
        const auto points = scene.texels.points_of(r.texel);
        for (std::size_t k = 0; k < std::min(points.size(), places_.size()); ++k) {
            if (!(hits.usable[receiver] >> k & 1u)) continue;
            const Vec3 n = geometric_normal(scene.rays.mesh(), points[k].triangle);
            places_[count_++] = {position(scene.rays.mesh(), points[k]), r.back ? -n : n};
        }
    }
    bool empty() const { return count_ == 0; }
    const Place& any(float u) const { return places_[std::min(std::size_t(u * float(count_)), count_ - 1)]; }

  private:
    std::array<Place, 16> places_;
    std::size_t count_ = 0;
};

/// Lux of one lamp at one place, shadow included.
Rgb lamp_at(const RayScene& rays, const PlacedLight& lamp, const Place& place) {
    const Vec3 to_light = lamp.position - place.position;
    const float distance = glm::length(to_light);
    if (!(distance > 0.0f)) return Rgb(0.0f);
    const Vec3 direction = to_light / distance;
    const float cosine = glm::dot(direction, place.normal);
    if (cosine <= 0.0f) return Rgb(0.0f);
    const Rgb facing = facing_irradiance(lamp, to_light);
    if (facing == Rgb(0.0f)) return Rgb(0.0f);
    const Vec3 origin = RayScene::offset_origin(place.position, place.normal, direction);
    const float length = glm::length(lamp.position - origin);
    return cosine * rays.transmittance({origin, direction, 0.0f, length}) * facing;
}

Rgb few_lamps(const GatherScene& scene, const UsablePoints& points, std::span<const std::size_t> lamps, Random& random) {
    Rgb sum(0.0f);
    for (std::size_t lamp : lamps)
        for (int s = 0; s < kLampSamples; ++s)
            sum += lamp_at(scene.rays, scene.lamps[lamp], points.any(random.next())) / float(kLampSamples);
    return sum;
}

/// Lamps chosen by what they would give without shadows.
Rgb many_lamps(const GatherScene& scene, const UsablePoints& points, std::span<const std::size_t> lamps,
               std::span<const double> cumulative, Random& random) {
    Rgb sum(0.0f);
    for (int s = 0; s < kManyLampSamples; ++s) {
        const double u = (s + random.next_double()) / kManyLampSamples * cumulative.back();
        const std::size_t i = std::min(std::size_t(std::upper_bound(cumulative.begin(), cumulative.end(), u) - cumulative.begin()),
                                       lamps.size() - 1);
        const double chance = (cumulative[i] - (i ? cumulative[i - 1] : 0.0)) / cumulative.back();
        sum += lamp_at(scene.rays, scene.lamps[lamps[i]], points.any(random.next())) / float(chance * kManyLampSamples);
    }
    return sum;
}

}  // namespace

std::vector<Rgb> lamp_irradiance(const GatherScene& scene, const GatherHits& hits, const GatherSettings& settings,
                                 const StageProgress& progress) {
    std::vector<Rgb> result(hits.receivers.size(), Rgb(0.0f));
    if (scene.lamps.empty()) return result;
    for_each_parallel(result.size(), progress, [&](std::size_t r) {
        const UsablePoints points(scene, hits, r);
        if (hits.buried(r) || points.empty()) return;
        std::vector<std::size_t> reaching;
        std::vector<double> cumulative;
        double sum = 0.0;
        const Vec3 middle = scene.texels.position[hits.receivers[r].texel];
        for (std::size_t lamp = 0; lamp < scene.lamps.size(); ++lamp) {
            const double facing = luminance(facing_irradiance(scene.lamps[lamp], scene.lamps[lamp].position - middle));
            if (!(facing > 0.0)) continue;
            reaching.push_back(lamp);
            cumulative.push_back(sum += facing);
        }
        if (reaching.empty()) return;
        Random random(settings.seed, r, kLampStream);
        result[r] = reaching.size() <= kFewLamps ? few_lamps(scene, points, reaching, random)
                                                 : many_lamps(scene, points, reaching, cumulative, random);
    });
    return result;
}

void add_sun_irradiance(const GatherScene& scene, const GatherHits& hits, std::span<const Lighting> hours,
                        const GatherSettings& settings, std::size_t receiver, Rgb* out) {
    if (hits.buried(receiver)) return;
    const UsablePoints points(scene, hits, receiver);
    if (points.empty()) return;
    for (std::size_t hour = 0; hour < hours.size(); ++hour) {
        // The same numbers at every hour, so that noise stands still.
        Random random(settings.seed, receiver, kSunStream);
        for (const Sun& sun : hours[hour].suns)
            for (int s = 0; s < kSunSamples; ++s) {
                // Stratified over the points and the rings of the disc.
                const Place& place = points.any((float(s) + random.next()) / float(kSunSamples));
                const Vec2 u((float((s * 3) % kSunSamples) + random.next()) / float(kSunSamples), random.next());
                if (glm::dot(sun.direction, place.normal) < -float(kSunRadius)) continue;
                const Vec3 direction = sample_sun_disc(sun.direction, u);
                const float cosine = glm::dot(direction, place.normal);
                if (cosine <= 0.0f) continue;
                const Vec3 origin = RayScene::offset_origin(place.position, place.normal, direction);
                const float open = scene.rays.transmittance({origin, direction});
                out[hour] += cosine * open / float(kSunSamples) * sun.irradiance;
            }
    }
}

std::uint32_t sky_bin(const Vec3& direction) {
    const Vec2 uv = latlong_from_direction(direction);
    const int x = std::clamp(int(uv.x * float(kSkyColumns)), 0, kSkyColumns - 1);
    const int y = std::clamp(int(uv.y * float(kSkyRows)), 0, kSkyRows - 1);
    return std::uint32_t(y * kSkyColumns + x);
}

std::vector<Rgb> sky_bins(const Environment& sky) {
    std::vector<Rgb> bins(std::size_t(kSkyRows) * kSkyColumns, Rgb(0.0f));
    if (sky.map.empty()) return bins;
    // Enough points that none of an image's pixels is missed.
    const int across = std::max(4, (sky.map.width + kSkyColumns - 1) / kSkyColumns);
    for (int bin = 0; bin < int(bins.size()); ++bin) {
        glm::dvec3 sum(0.0);
        double weights = 0.0;
        for (int i = 0; i < across * across; ++i) {
            const Vec2 uv((float(bin % kSkyColumns) + (float(i % across) + 0.5f) / float(across)) / float(kSkyColumns),
                          (float(bin / kSkyColumns) + (float(i / across) + 0.5f) / float(across)) / float(kSkyRows));
            const double weight = std::sin(kPi * double(uv.y));
            sum += weight * glm::dvec3(sky.radiance(direction_from_latlong(uv)));
            weights += weight;
        }
        bins[std::size_t(bin)] = Rgb(sum / weights);
    }
    return bins;
}

}  // namespace daylit
