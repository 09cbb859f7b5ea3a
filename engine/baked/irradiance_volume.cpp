#include "engine/baked/irradiance_volume.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr std::size_t kCoefficients = glsl::kShCoefficients;

Rgb unpack(const std::uint16_t* half) {
    return {glm::unpackHalf1x16(half[0]), glm::unpackHalf1x16(half[1]), glm::unpackHalf1x16(half[2])};
}

/// A coordinate between two probes of one axis.
struct Between {
    int below, above;
    float share;  // of `above`
};

Between locate(float coordinate, int size) {
    const float x = std::clamp(coordinate, 0.0f, float(size - 1));
    const int below = std::min(int(x), size - 1);
    return {below, std::min(below + 1, size - 1), x - float(below)};
}

}  // namespace

Rgb IrradianceVolume::irradiance(const Vec3& place, const Vec3& normal, std::span<const float> weights) const {
    const Vec3 grid = (place - origin) / spacing;
    const Between x = locate(grid.x, size[0]), y = locate(grid.y, size[1]), z = locate(grid.z, size[2]);
    const glsl::Sh9 lobe = glsl::sh_irradiance_weights(normal);
    Rgb sum(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        const float share = (corner & 1 ? x.share : 1.0f - x.share) * (corner & 2 ? y.share : 1.0f - y.share) *
                            (corner & 4 ? z.share : 1.0f - z.share);
        if (share == 0.0f) continue;
        const std::size_t probe = (std::size_t(corner & 4 ? z.above : z.below) * std::size_t(size[1]) +
                                   std::size_t(corner & 2 ? y.above : y.below)) *
                                      std::size_t(size[0]) +
                                  std::size_t(corner & 1 ? x.above : x.below);
        for (std::size_t r = 0; r < weights.size(); ++r)
            for (std::size_t i = 0; i < kCoefficients; ++i)
                sum += share * weights[r] * lobe.c[i] *
                       unpack(components.data() + 3 * ((r * kCoefficients + i) * probes() + probe));
    }
    return glm::max(sum, Rgb(0.0f));
}

std::vector<Rgb> IrradianceVolume::combined(std::span<const float> weights) const {
    const std::size_t count = kCoefficients * probes();
    std::vector<Rgb> sum(count, Rgb(0.0f));
    for (std::size_t r = 0; r < weights.size(); ++r) {
        if (weights[r] == 0.0f) continue;
        const std::uint16_t* half = components.data() + 3 * r * count;
        for (std::size_t i = 0; i < count; ++i) sum[i] += weights[r] * unpack(half + 3 * i);
    }
    return sum;
}

}  // namespace daylit
