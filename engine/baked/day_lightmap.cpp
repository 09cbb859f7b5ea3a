#include "engine/baked/day_lightmap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/baked/bilinear.h"

namespace daylit {
namespace {

/// The sum of a texel's patterns. plane: the first slot's numbers; slots lie `stride` apart
Rgb pattern_sum(const DayLightmap& map, int x, int y, const std::int16_t* plane, std::size_t stride,
                std::span<const Rgb> tile_light) {
    const std::size_t texel = std::size_t(y) * std::size_t(map.width) + std::size_t(x);
    const std::size_t tile = map.tile_at(x, y);
    Rgb sum(0.0f);
    for (std::size_t p = 0; p < map.tile_patterns[tile]; ++p)
        sum += std::ldexp(float(plane[p * stride + texel]), -2 * int(map.exponents[texel])) *
               tile_light[tile * DayLightmap::kMostPatterns + p];
    return sum;
}

/// One texel: the patterns are summed first and clamped then, as the relight pass does, so that a bilinear fetch mixes
/// light that exists.
Rgb relit_texel(const DayLightmap& map, int x, int y, std::span<const Rgb> tile_light) {
    return glm::max(pattern_sum(map, x, y, map.values.data(), map.texels(), tile_light), Rgb(0.0f));
}

Rgb relit_tilt(const DayLightmap& map, int x, int y, std::size_t axis, std::span<const Rgb> tile_light) {
    if (map.tilts.empty() || !map.tile_tilted[map.tile_at(x, y)]) return Rgb(0.0f);
    return DayLightmap::kTiltScale *
           pattern_sum(map, x, y, map.tilts.data() + axis * map.texels(), 2 * map.texels(), tile_light);
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

std::size_t DayLightmap::tile_at(int x, int y) const {
    return std::size_t(y / kTileSide) * std::size_t(tiles_across()) + std::size_t(x / kTileSide);
}

Rgb DayLightmap::irradiance(const Vec2& uv, std::span<const Rgb> tile_light) const {
    return bilinear(width, height, uv, [&](int x, int y) { return relit_texel(*this, x, y, tile_light); });
}

Rgb DayLightmap::irradiance(const Vec2& uv, const Vec3& lean, std::span<const Rgb> tile_light) const {
    const auto tilt = [&](std::size_t axis) {
        return bilinear(width, height, uv, [&](int x, int y) { return relit_tilt(*this, x, y, axis, tile_light); });
    };
    return glsl::tilted_irradiance(irradiance(uv, tile_light), tilt(0), tilt(1), lean);
}

}  // namespace daylit
