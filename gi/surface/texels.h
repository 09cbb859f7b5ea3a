#pragma once
// Where on the surface each texel of the atlas lies.
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gi/surface/atlas.h"

namespace daylit {

/// A point of the surface inside a texel's footprint.
struct TexelPoint {
    std::uint32_t triangle = 0;
    Vec2 barycentric = Vec2(0.0f);  // weights of the triangle's second and third corner
};

inline constexpr float kSightHeight = 0.25f;  // texels above the surface, between which sight is tested

/// The texels that surface lies in, numbered chart by chart, row by row; the others of a chart's grid are fetched by
/// bilinear filtering only and filled from these.
struct Texels {
    std::vector<std::uint32_t> first_cell;     // of each chart's grid; one more than charts
    std::vector<std::uint32_t> texel_of_cell;  // nx * ny per chart, row by row; kNoTexel: no surface in its footprint;
                                               // of several parts the first
    std::vector<std::uint32_t> chart;          // of each texel
    std::vector<std::uint32_t> cell;           // of each texel, index into texel_of_cell
    std::vector<std::uint32_t> next_part;      // of each texel: a further one of the same cell, whose points are apart
    std::vector<std::uint32_t> first_point;    // of each texel; one more than texels
    std::vector<TexelPoint> points;            // up to 16 a texel, spread over its footprint
    std::vector<Vec3> position;                // mean of its points
    std::vector<Vec3> normal;                  // unit, mean of its points' geometric normals
    std::vector<Vec3> along_u;  // unit, along the surface: in which the atlas coordinate u grows, v still
    std::vector<float> width;   // metres: the side of a square as large as a texel of this chart

    std::vector<std::uint8_t> covered;  // of each texel, not 0: something lies on it, or close above; empty: unknown
    std::vector<std::uint8_t> walled;   // of each texel, not 0: something stands in its cell or beside; empty: unknown

    std::size_t count() const { return chart.size(); }
    std::span<const TexelPoint> points_of(std::size_t texel) const {
        return {points.data() + first_point[texel], first_point[texel + 1] - first_point[texel]};
    }
    /// The texel that a point of a triangle belongs to: its own, or the nearest of the chart that has surface; of a
    /// parted one the part with the nearest point.
    std::uint32_t at(const Atlas& atlas, std::uint32_t triangle, const Vec2& barycentric) const;

    /// A little above a texel's middle, where a kerb hides nothing.
    Vec3 above(std::uint32_t texel) const { return position[texel] + kSightHeight * width[texel] * normal[texel]; }
    /// Calls use(texel) for this part of a cell and those after it.
    template <class Use>
    void for_parts(std::uint32_t texel, const Use& use) const {
        for (; texel != ~0u; texel = next_part[texel]) use(texel);
    }

    /// For cells without surface: the nearest texel of the same chart; for the others themselves.
    std::vector<std::uint32_t> nearest_texel_of_cell;
};
inline constexpr std::uint32_t kNoTexel = ~0u;

/// Calls use(texel) for the first parts of the cells around a texel's, `reach` of them on every side, and of its own,
/// row by row.
template <class Use>
void for_texels_around(const Atlas& atlas, const Texels& texels, std::uint32_t texel, int reach, const Use& use) {
    const std::uint32_t chart = texels.chart[texel], first = texels.first_cell[chart];
    const PlacedChart& c = atlas.charts[chart];
    const int x = int(texels.cell[texel] - first) % c.nx, y = int(texels.cell[texel] - first) / c.nx;
    for (int ny = std::max(y - reach, 0); ny <= std::min(y + reach, c.ny - 1); ++ny)
        for (int nx = std::max(x - reach, 0); nx <= std::min(x + reach, c.nx - 1); ++nx)
            if (const std::uint32_t other = texels.texel_of_cell[first + std::uint32_t(ny * c.nx + nx)];
                other != kNoTexel)
                use(other);
}

/// Metres: the side of a square as large as a texel of the chart.
float texel_width(const PlacedChart& chart);

/// Which of a cell's points, in a texel of this width (metres), make a texel of their own: a number for each point,
/// from 0 without gaps.
using PointParting = std::function<std::vector<int>(std::span<const TexelPoint>, float width)>;

/// part   null: all points of a cell are one texel
Texels make_texels(const WorldMesh& mesh, const Atlas& atlas, const PointParting& part = nullptr);

Vec3 position(const WorldMesh& mesh, const TexelPoint& point);
Vec3 geometric_normal(const WorldMesh& mesh, std::uint32_t triangle);

/// For every cell of a chart's grid (nx * ny, row by row) the nearest one for which `usable` holds, by breadth-first
/// search over four neighbours, lower indices first; kNoTexel everywhere when none is.
std::vector<std::uint32_t> nearest_usable(int nx, int ny, const std::vector<bool>& usable);

/// Texels that are neither marked themselves nor beside a marked one, across a corner included, in their chart.
std::vector<bool> away_from(const Atlas& atlas, const Texels& texels, const std::vector<bool>& marked);

}  // namespace daylit
