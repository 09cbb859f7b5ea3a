// Straight light of what does not move, on the receivers.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/random.h"
#include "gi/transport/day_gather/places.h"
#include "gi/transport/day_gather/sequence.h"
#include "gi/transport/day_gather/streams.h"

namespace daylit {
namespace {

constexpr int kSunSamples = 4;
constexpr int kLampSamples = 2;  // per lamp, where few lamps reach
constexpr std::size_t kFewLamps = 8;
constexpr int kManyLampSamples = 16;  // in all, where many do

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

ByLit few_lamps(const GatherScene& scene, const UsablePoints& points, std::span<const std::size_t> lamps,
                Random& random) {
    ByLit sum;
    for (std::size_t lamp : lamps)
        for (int s = 0; s < kLampSamples; ++s)
            sum.of(scene.lamps[lamp].lit) +=
                lamp_at(scene.rays, scene.lamps[lamp], points.any(random.next())) / float(kLampSamples);
    return sum;
}

/// Lamps chosen by what they would give without shadows.
ByLit many_lamps(const GatherScene& scene, const UsablePoints& points, std::span<const std::size_t> lamps,
                 std::span<const double> cumulative, Random& random) {
    ByLit sum;
    for (int s = 0; s < kManyLampSamples; ++s) {
        const double u = (s + random.next_double()) / kManyLampSamples * cumulative.back();
        const std::size_t i =
            std::min(std::size_t(std::upper_bound(cumulative.begin(), cumulative.end(), u) - cumulative.begin()),
                     lamps.size() - 1);
        const double chance = (cumulative[i] - (i ? cumulative[i - 1] : 0.0)) / cumulative.back();
        const PlacedLight& lamp = scene.lamps[lamps[i]];
        sum.of(lamp.lit) += lamp_at(scene.rays, lamp, points.any(random.next())) / float(chance * kManyLampSamples);
    }
    return sum;
}

}  // namespace

std::vector<ByLit> lamp_irradiance(const GatherScene& scene, const GatherHits& hits, const GatherSettings& settings,
                                   const StageProgress& progress) {
    std::vector<ByLit> result(hits.receivers.size());
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

std::vector<Rgb> sun_irradiance(const GatherScene& scene, const GatherHits& hits, std::span<const Sun> suns,
                                const GatherSettings& settings, const StageProgress& progress) {
    std::vector<Rgb> result(hits.receivers.size(), Rgb(0.0f));
    for_each_parallel(result.size(), progress, [&](std::size_t r) {
        const UsablePoints points(scene, hits, r);
        if (hits.buried(r) || points.empty()) return;
        Random random(settings.seed, r, kSunStream);
        for (const Sun& sun : suns)
            for (int s = 0; s < kSunSamples; ++s) {
                // Stratified over the points and the rings of the disc.
                const Place& place = points.any((float(s) + random.next()) / float(kSunSamples));
                const Vec2 u((float((s * 3) % kSunSamples) + random.next()) / float(kSunSamples), random.next());
                if (glm::dot(sun.direction, place.normal) < -float(kSunRadius)) continue;
                const Vec3 direction = Frame(sun.direction).to_world(sample_sun_disc(u));
                const float cosine = glm::dot(direction, place.normal);
                if (cosine <= 0.0f) continue;
                const Vec3 origin = RayScene::offset_origin(place.position, place.normal, direction);
                const float open = scene.rays.transmittance({origin, direction});
                result[r] += cosine * open / float(kSunSamples) * sun.irradiance;
            }
    });
    return result;
}

}  // namespace daylit
