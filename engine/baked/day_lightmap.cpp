#include "engine/baked/day_lightmap.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace daylit {
namespace {

/// One texel at one hour: the components are summed first and clamped then, as the relight pass does, so that a
/// bilinear fetch mixes light that exists.
Rgb relit_texel(const DayLightmap& map, int x, int y, std::span<const float> weights) {
    const std::size_t texels = std::size_t(map.width) * std::size_t(map.height);
    const std::size_t texel = std::size_t(y) * std::size_t(map.width) + std::size_t(x);
    Rgb sum(0.0f);
    for (std::size_t r = 0; r < weights.size(); ++r) {
        const std::uint16_t* half = map.components.data() + 3 * (r * texels + texel);
        sum += weights[r] *
               Rgb(glm::unpackHalf1x16(half[0]), glm::unpackHalf1x16(half[1]), glm::unpackHalf1x16(half[2]));
    }
    return glm::max(sum, Rgb(0.0f));
}

}  // namespace

Rgb DayLightmap::irradiance(const Vec2& uv, std::span<const float> weights) const {
    const float x = std::clamp(uv.x * float(width) - 0.5f, 0.0f, float(width - 1));
    const float y = std::clamp(uv.y * float(height) - 0.5f, 0.0f, float(height - 1));
    const int x0 = int(x), y0 = int(y);
    const int x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
    const float fx = x - float(x0), fy = y - float(y0);
    const Rgb top = glm::mix(relit_texel(*this, x0, y0, weights), relit_texel(*this, x1, y0, weights), fx);
    const Rgb bottom = glm::mix(relit_texel(*this, x0, y1, weights), relit_texel(*this, x1, y1, weights), fx);
    return glm::mix(top, bottom, fy);
}

}  // namespace daylit
