#pragma once
// Indirect irradiance on static surfaces over the day.
#include <cstdint>
#include <span>
#include <vector>

#include "engine/baked/day_basis.h"
#include "engine/base/units.h"

namespace daylit {

/// An atlas of texels over the static triangles; each texel's E over the day is a row of the basis.
struct DayLightmap {
    int width = 0, height = 0;
    DayBasis basis;
    /// components images of width * height RGB halves (IEEE 754 binary16), row 0 at v = 0, component-major; lux.
    std::vector<std::uint16_t> components;
    /// Atlas coordinates in [0,1], three per triangle of world_mesh(scene, pose, Part::Static), in its order.
    /// Gutters are filled, so bilinear fetches at any point of a triangle stay inside its chart.
    std::vector<Vec2> corner_uvs;

    /// *Indirect* E in lux at uv, bilinear, never negative; weights = basis.weights(hour). Same as the shader's fetch.
    Rgb irradiance(const Vec2& uv, std::span<const float> weights) const;
};

}  // namespace daylit
