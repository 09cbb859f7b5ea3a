#include "gi/transport/day_gather/more_rays.h"

#include <algorithm>
#include <cmath>

#include "gi/transport/day_gather/receiver_rays.h"
#include "gi/transport/day_gather/sight.h"

namespace daylit {
namespace {

constexpr int kRound = 4;  // of random numbers: 0 are the first rays', 1 lamps', 2 suns', 3 probes'

/// Sums over the further rays of one texel.
struct Sums {
    int rays = 0;
    std::array<float, HalvedLight::kMostNumbers> light{}, u{}, v{};
};

class Gatherer {
  public:
    Gatherer(const GatherScene& scene, const GatherHits& hits, const HalvedLight& light)
        : scene_(scene), hits_(hits), light_(light), sight_(scene), back_(scene.texels.count(), kNoLight) {
        for (auto r = std::uint32_t(scene.texels.count()); r < hits.receivers.size(); ++r)
            back_[hits.receivers[r].texel] = r;
    }

    Sums gather(const GatherSettings& settings, std::uint32_t texel, bool tilted) const {
        ReceiverRays rays(scene_, settings, {texel, false}, kRound);
        const TiltFrame frame = tilt_frame(scene_, texel);
        Sums sums;
        for (int j = 0; j < settings.rays; ++j) {
            const std::size_t k = rays.point_of(j);
            if (!(hits_.usable[texel] >> k & 1u)) continue;
            ++sums.rays;
            const Vec3& normal = rays.normal_of(k);
            const Vec3 direction = rays.direction(j);
            const std::uint32_t hit = met(rays.position_of(k), normal, direction, rays.random());
            if (hit == kNoLight) continue;
            light_.add(hits_.source(hit), sums.light.data());
            if (tilted)
                light_.add(hits_.source(hit), tilt_weights(frame, normal, direction), sums.u.data(), sums.v.data());
        }
        return sums;
    }

  private:
    std::uint32_t met(const Vec3& position, const Vec3& normal, const Vec3& direction, Random& random) const {
        Ray ray{RayScene::offset_origin(position, normal, direction), direction};
        const std::optional<Hit> hit = sight_.past_glass(ray, random);
        if (!hit) return kSkyBit | sky_bin(ray.direction);
        const std::uint32_t texel = texel_at(scene_, ray, *hit);
        if (texel == kNoTexel) return kNoLight;
        return glm::dot(ray.direction, hit->normal) > 0.0f ? back_[texel] : texel;
    }

    const GatherScene& scene_;
    const GatherHits& hits_;
    const HalvedLight& light_;
    Sight sight_;
    std::vector<std::uint32_t> back_;  // per texel: the receiver behind it
};

/// Moves a row of gathered light towards the mean of the further rays. `apart`: light in it that was not gathered.
void mix(std::span<Rgb> row, const float* sums, float mean, float share, const DayBasisCurves& basis,
         const ByLit& apart) {
    for (std::size_t i = 0; i < row.size(); ++i)
        row[i] += share * (mean * Rgb(sums[3 * i], sums[3 * i + 1], sums[3 * i + 2]) - row[i]);
    row[basis.component_of(StillPart::Evening)] += share * apart.evening;
    row[basis.component_of(StillPart::Lamps)] += share * apart.always;
}

}  // namespace

std::vector<int> share_out_rays(const GatherHits& hits, std::span<const float> noise, const std::vector<bool>& wanted,
                                double mean, double target, double most) {
    const auto rays = double(hits.rays);
    std::vector<int> more(noise.size(), 0);
    const auto add_at = [&](double level) {  // rays enough that noise falls with its root to `level`
        double sum = 0.0;
        for (std::size_t t = 0; t < noise.size(); ++t) {
            if (!wanted[t] || !(double(noise[t]) > target)) continue;
            const double enough = rays * std::min(double(noise[t]) / target * (double(noise[t]) / target), 1.0 + most);
            more[t] = int(std::max(std::min(rays * double(noise[t]) / level, enough) - rays, 0.0));
            sum += double(more[t]);
        }
        return sum;
    };
    const double budget = mean * double(noise.size());
    double low = 1e-6, high = 1e6;
    for (int step = 0; step < 60; ++step) {
        const double middle = std::sqrt(low * high);
        (add_at(middle) > budget ? low : high) = middle;
    }
    add_at(high);
    return more;
}

void gather_more(const GatherScene& scene, const GatherHits& hits, const DaySolution& day, const HalvedLight& light,
                 const GatherSettings& settings, std::span<const int> more, std::span<Rgb> texels, TexelTilts& tilts,
                 std::span<float> noise, const StageProgress& progress) {
    const Gatherer gatherer(scene, hits, light);
    const std::size_t components = day.basis.components;
    std::vector<std::uint32_t> which;
    for (std::uint32_t t = 0; t < more.size(); ++t)
        if (more[t] > 0) which.push_back(t);
    for_each_parallel(which.size(), progress, [&](std::size_t i) {
        const std::uint32_t t = which[i];
        const std::uint32_t tilt = tilts.count() > 0 ? tilts.row_of_texel[t] : ~0u;
        GatherSettings further = settings;
        further.rays = more[t];
        const Sums sums = gatherer.gather(further, t, tilt != ~0u);
        if (sums.rays == 0) return;
        const float share = float(sums.rays) / (float(sums.rays) + 1.0f / hits.scale[t]),
                    each = 1.0f / float(sums.rays);
        mix(texels.subspan(t * components, components), sums.light.data(), each, share, day.basis, hits.emission[t]);
        noise[t] *= std::sqrt(1.0f - share);
        if (tilt == ~0u) return;
        const std::span<Rgb> rows(tilts.rows.data() + std::size_t(tilt) * 2 * components, 2 * components);
        mix(rows.first(components), sums.u.data(), each, share, day.basis, hits.emission_tilts[t][0]);
        mix(rows.last(components), sums.v.data(), each, share, day.basis, hits.emission_tilts[t][1]);
    });
}

}  // namespace daylit
