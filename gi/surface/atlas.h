#pragma once
// The atlas: charts cut into texels and packed into one image.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "gi/surface/charts.h"
#include "gi/surface/kept_layout.h"

namespace daylit {

/// A chart with its grid of texels. Along an axis of an unwrapped chart texel centres lie a step apart from rim to rim:
/// neighbouring charts of a wall or floor have texels on the edge that they share, and a side with a single texel
/// covers the whole extent. Charts of a kept layout lie on the texels of that layout instead.
struct PlacedChart {
    Chart chart;
    int nx = 1, ny = 1;
    Vec2 step = Vec2(0.0f);  // metres between texel centres; the full extent where there is one texel
    int x = 0, y = 0;        // of texel (0, 0) in the atlas
    /// Sides with a single texel take two in the atlas, the second a copy, so that a bilinear fetch between them needs
    /// no gutter to a neighbour.
    int atlas_width() const { return nx == 1 ? 2 : nx; }
    int atlas_height() const { return ny == 1 ? 2 : ny; }
    /// The texel whose footprint holds a place of the grid.
    int nearest_x(const Vec2& grid) const { return std::clamp(int(grid.x + 0.5f), 0, nx - 1); }
    int nearest_y(const Vec2& grid) const { return std::clamp(int(grid.y + 0.5f), 0, ny - 1); }
};

struct Atlas {
    int width = 1, height = 1;
    std::vector<PlacedChart> charts;               // those of one kept layout may interlock
    std::vector<std::uint32_t> chart_of_triangle;  // kNoChart for triangles without area
    /// Three per triangle: place in its chart's grid, with texel centres at whole numbers; along a side with a single
    /// texel 0 to 1 over the extent.
    std::vector<Vec2> corner_grids;
    std::vector<Vec2> corner_uvs;  // as DayLightmap::corner_uvs

    /// Place in the grid of a triangle's chart. barycentric: weights of the triangle's second and third corner
    Vec2 grid(std::uint32_t triangle, const Vec2& barycentric) const {
        const Vec2* c = &corner_grids[3 * std::size_t(triangle)];
        return c[0] + barycentric.x * (c[1] - c[0]) + barycentric.y * (c[2] - c[0]);
    }
};
inline constexpr std::uint32_t kNoChart = ~0u;

/// Metres between texels, could all surface be cut evenly.
/// throws Error for a budget of more than 16384 x 16384 texels.
float even_step(const WorldMesh& mesh, std::size_t texel_budget);

/// Texels as small as the budget allows: finer where the surroundings are near, since light varies over a share of
/// their distance; coarse where nothing is near, and coarsest where nobody can look.
/// around   per triangle; empty: all alike
/// kept     layouts that stay as they are; the triangles that have none are unwrapped
/// throws Error when the charts do not fit into 16384 x 16384 texels.
Atlas make_atlas(const WorldMesh& mesh, std::size_t texel_budget, std::span<const Surroundings> around = {},
                 const KeptLayouts& kept = {});

}  // namespace daylit
