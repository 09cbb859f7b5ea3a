#include "engine/baked/day_lightmap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace daylit {
namespace {

/// One texel: the patterns are summed first and clamped then, as the relight pass does, so that a bilinear fetch mixes
/// light that exists.
Rgb relit_texel(const DayLightmap& map, int x, int y, std::span<const Rgb> tile_light) {
    const std::size_t texel = std::size_t(y) * std::size_t(map.width) + std::size_t(x);
    const std::size_t tile = std::size_t(y / DayLightmap::kTileSide) * std::size_t(map.tiles_across()) +
                             std::size_t(x / DayLightmap::kTileSide);
    Rgb sum(0.0f);
    for (std::size_t p = 0; p < map.tile_patterns[tile]; ++p)
        sum += std::ldexp(float(map.values[p * map.texels() + texel]), -2 * int(map.exponents[texel])) *
               tile_light[tile * DayLightmap::kMostPatterns + p];
    return glm::max(sum, Rgb(0.0f));
}

}  // namespace

int DayLightmap::slots() const {
    return tile_patterns.empty() ? 0 : *std::max_element(tile_patterns.begin(), tile_patterns.end());
}

std::vector<Rgb> DayLightmap::tile_light(std::span<const Rgb> weights) const {
    std::vector<Rgb> result(tiles() * kMostPatterns, Rgb(0.0f));
    const std::int16_t* pattern = patterns.data();
    const float* scale = scales.data();
    for (std::size_t tile = 0; tile < tile_patterns.size(); ++tile)
        for (std::size_t p = 0; p < tile_patterns[tile]; ++p, ++scale)
            for (int c = 0; c < 3; ++c) {
                float sum = 0.0f;
                for (std::size_t r = 0; r < weights.size(); ++r) sum += float(*pattern++) * weights[r][c];
                result[tile * kMostPatterns + p][c] = *scale * sum;
            }
    return result;
}

Rgb DayLightmap::irradiance(const Vec2& uv, std::span<const Rgb> tile_light) const {
    const float x = std::clamp(uv.x * float(width) - 0.5f, 0.0f, float(width - 1));
    const float y = std::clamp(uv.y * float(height) - 0.5f, 0.0f, float(height - 1));
    const int x0 = int(x), y0 = int(y);
    const int x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
    const float fx = x - float(x0), fy = y - float(y0);
    const Rgb top = glm::mix(relit_texel(*this, x0, y0, tile_light), relit_texel(*this, x1, y0, tile_light), fx);
    const Rgb bottom = glm::mix(relit_texel(*this, x0, y1, tile_light), relit_texel(*this, x1, y1, tile_light), fx);
    return glm::mix(top, bottom, fy);
}

}  // namespace daylit
