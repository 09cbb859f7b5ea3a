#pragma once
// The atlas: charts cut into texels and packed into one image.
#include <cstdint>
#include <vector>

#include "gi/surface/charts.h"

namespace daylit {

/// A chart with its grid of texels. Texel (i, j) has its centre at (i, j) * step of the chart's plane, so the outermost
/// texels lie on the chart's rim: neighbouring charts of a wall or floor have texels on the edge that they share.
/// A side with a single texel covers the whole extent.
struct PlacedChart {
    Chart chart;
    int nx = 1, ny = 1;
    Vec2 step = Vec2(0.0f);  // metres between texel centres; the full extent where there is one texel
    int x = 0, y = 0;        // of texel (0, 0) in the atlas
    /// Sides with a single texel take two in the atlas, the second a copy, so that a bilinear fetch between them needs
    /// no gutter to a neighbour.
    int atlas_width() const { return nx == 1 ? 2 : nx; }
    int atlas_height() const { return ny == 1 ? 2 : ny; }
    /// Continuous texel coordinates of a point of the plane, (0,0) to (nx-1, ny-1).
    Vec2 grid(const Vec2& plane) const;
    /// The texel whose footprint holds it.
    int nearest_x(const Vec2& plane) const;
    int nearest_y(const Vec2& plane) const;
};

struct Atlas {
    int width = 1, height = 1;
    std::vector<PlacedChart> charts;
    std::vector<std::uint32_t> chart_of_triangle;  // kNoChart for triangles without area
    std::vector<Vec2> corner_uvs;                  // as DayLightmap::corner_uvs
};
inline constexpr std::uint32_t kNoChart = ~0u;

/// Metres between texels, could all surface be cut evenly.
float even_step(const WorldMesh& mesh, std::size_t texel_budget);

/// Texels as small as the budget allows: finer where the surroundings are near, since light varies over a share of
/// their distance; coarse where nothing is near, and coarsest where nobody can look. around   per triangle; empty: all
/// alike throws Error when the charts do not fit into 16384 x 16384 texels.
Atlas make_atlas(const WorldMesh& mesh, std::size_t texel_budget, std::span<const Surroundings> around = {});

}  // namespace daylit
