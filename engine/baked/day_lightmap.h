#pragma once
// Indirect irradiance on static surfaces over the day.
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/baked/light_basis.h"
#include "engine/base/units.h"
#include "shaders/shared/lightmap.h"

namespace daylit {

/// An atlas of texels over the static triangles, cut into square tiles. A tile has a few *patterns*, each a row of
/// light like that of a texel, in the components of the basis; a texel is a sum of its tile's patterns:
///     E(texel) = sum over p of value(texel, p) / 4^exponent(texel) * light(p),
///     light(p) = scale(p) * sum over r of pattern(p, r) * weight_r
/// So the patterns' light is worked out once a tile, and a texel costs one multiply-add of RGB a pattern.
/// Where a surface has a normal map, its texels also hold how E changes as the normal leans towards the directions u
/// and v in which the atlas coordinates grow on the surface (v completes u and the normal to a right-handed frame):
///     tilt(texel, axis) = kTiltScale * sum over p of tilts(texel, axis, p) / 4^exponent(texel) * light(p), lux a
///     radian
struct DayLightmap {
    static constexpr int kMostPatterns = glsl::kLightmapPatterns;
    static constexpr int kTileSide = glsl::kLightmapTileSide;
    inline static const float kTiltScale = glsl::kLightmapTiltScale;
    static constexpr int kLargestValue = 2047;  // so that value / 4^exponent is exact in a half float
    static constexpr int kLargestExponent = 7;

    int width = 0, height = 0;
    LightBasis basis;
    std::vector<std::uint8_t> tile_patterns;  // per tile, row by row: how many, 0 to kMostPatterns
    std::vector<float> scales;                // per pattern, tile by tile
    std::vector<std::int16_t> patterns;       // [pattern][channel][basis.components]
    std::vector<std::int16_t> values;         // [slot][height][width]: of the tile's pattern `slot`; row 0 at v = 0
    std::vector<std::uint8_t> exponents;      // [height][width]
    std::vector<std::uint8_t> tile_tilted;    // per tile: 1 when its texels have tilts; empty: none has
    std::vector<std::int16_t> tilts;          // [slot][u, v][height][width]; empty when no tile has any
    double error = 0.0;                       // of the encoding, as measured when it was made (gi/encode)
    /// Atlas coordinates in [0,1], three per triangle of world_mesh(scene, pose, Part::Static), in its order.
    /// Gutters are filled, so bilinear fetches at any point of a triangle stay inside its chart.
    std::vector<Vec2> corner_uvs;

    int tiles_across() const { return (width + kTileSide - 1) / kTileSide; }
    int tiles_down() const { return (height + kTileSide - 1) / kTileSide; }
    std::size_t tile_at(int x, int y) const;
    std::size_t tiles() const { return std::size_t(tiles_across()) * std::size_t(tiles_down()); }
    bool tilted() const {
        return std::any_of(tile_tilted.begin(), tile_tilted.end(), [](auto t) { return t != 0; });
    }
    std::size_t texels() const { return std::size_t(width) * std::size_t(height); }
    /// Patterns of the fullest tile.
    int slots() const;

    /// The light of every tile's patterns, lux: [tile][kMostPatterns], zero where a tile has fewer.
    /// weights = basis.weights(scales, hour)
    std::vector<Rgb> tile_light(std::span<const Rgb> weights) const;

    /// *Indirect* E in lux at uv, bilinear, never negative. Same as the shader's fetch.
    Rgb irradiance(const Vec2& uv, std::span<const Rgb> tile_light) const;
    /// The same for a normal that leans from the surface's: its coordinates along u, v and the surface's normal, unit.
    Rgb irradiance(const Vec2& uv, const Vec3& lean, std::span<const Rgb> tile_light) const;
};

}  // namespace daylit
