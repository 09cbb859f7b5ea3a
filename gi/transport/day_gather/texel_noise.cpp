#include "gi/transport/day_gather/texel_noise.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

constexpr float kDarkest = 1e-4f;  // of the texels' mean light

AtMoments mean(const std::vector<AtMoments>& rows) {
    std::array<double, kNoiseMoments> sum{};
    for (const AtMoments& row : rows)
        for (std::size_t k = 0; k < kNoiseMoments; ++k) sum[k] += double(row[k]);
    AtMoments result;
    for (std::size_t k = 0; k < kNoiseMoments; ++k)
        result[k] = float(sum[k] / double(std::max<std::size_t>(rows.size(), 1)));
    return result;
}

/// Variance of the mean over a texel's rays.
AtMoments variance_of_mean(const GatherHits& hits, const std::vector<AtMoments>& sources, std::size_t texel) {
    AtMoments sum{}, squares{};
    const std::uint32_t* hit = hits.hit.data() + texel * std::size_t(hits.rays);
    for (int j = 0; j < hits.rays; ++j) {
        if (hit[j] == kNoLight) continue;
        const AtMoments& light = sources[hits.source(hit[j])];
        for (std::size_t k = 0; k < kNoiseMoments; ++k) sum[k] += light[k], squares[k] += light[k] * light[k];
    }
    const float share = hits.scale[texel];  // 1 / rays that count
    AtMoments result;
    for (std::size_t k = 0; k < kNoiseMoments; ++k)
        result[k] = share * std::max(share * squares[k] - share * sum[k] * (share * sum[k]), 0.0f);
    return result;
}

}  // namespace

MomentLight::MomentLight(std::span<const std::vector<Rgb>> weights)
    : components_(weights[0].size()), weights_(3 * components_) {
    const Rgb eye(luminance(Rgb(1, 0, 0)), luminance(Rgb(0, 1, 0)), luminance(Rgb(0, 0, 1)));
    for (std::size_t i = 0; i < components_; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < kNoiseMoments; ++k)
                weights_[3 * i + c][k] = eye[int(c)] * weights[std::min(k, weights.size() - 1)][i][int(c)];
}

AtMoments MomentLight::of(const Rgb* row) const {
    AtMoments result{};
    for (std::size_t i = 0; i < components_; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < kNoiseMoments; ++k) result[k] += row[i][int(c)] * weights_[3 * i + c][k];
    return result;
}

std::vector<float> texel_noise(const GatherHits& hits, const DaySolution& day, const MomentLight& moments) {
    const StageProgress silent{Progress{}};
    std::vector<AtMoments> sources(hits.receivers.size() + kSkyBins);
    for_each_parallel(sources.size(), silent, [&](std::size_t i) { sources[i] = moments.of(day.leaves(i)); });
    std::vector<AtMoments> light(day.texels.size() / day.basis.components);
    for_each_parallel(light.size(), silent, [&](std::size_t t) { light[t] = moments.of(day.texel(t)); });
    const AtMoments all = mean(light);
    std::vector<float> noise(light.size(), 0.0f);
    for_each_parallel(light.size(), silent, [&](std::size_t t) {
        if (hits.buried(t)) return;
        const AtMoments variance = variance_of_mean(hits, sources, t);
        for (std::size_t k = 0; k < kNoiseMoments; ++k) {
            const float against = std::max(light[t][k], kDarkest * all[k]);
            if (against > 0.0f) noise[t] = std::max(noise[t], std::sqrt(variance[k]) / against);
        }
    });
    return noise;
}

}  // namespace daylit
