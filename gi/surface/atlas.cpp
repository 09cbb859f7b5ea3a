#include "gi/surface/atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/error.h"
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_rect_pack.h>
#pragma GCC diagnostic pop

namespace daylit {
namespace {

constexpr int kMaxSide = 16384, kMaxChartSide = 2048;

[[noreturn]] void refuse_size() {
    throw Error("lightmap",
                "the static surfaces need more than 16384 x 16384 texels; bake with a coarser "
                "--quality or split the scene");
}
constexpr float kWideArea = 100.0f;  // square metres: larger charts get coarser, with the fourth root of their area
// Fetches keep this far, in texels, inside the outermost texel centres: more than the 1/256 of a GPU's fixed-point
// filter, so no neighbour in the atlas is touched.
constexpr float kInset = 1.0f / 128.0f;

int texels_along(float size, float step) {
    return std::clamp(1 + int(std::min(size / step + 0.5f, 1e6f)), 1, kMaxChartSide);
}

float wide_factor(const Vec2& size) {
    return std::max(1.0f, std::pow(size.x * size.y / kWideArea, 0.25f));
}

std::size_t texels_at(const std::vector<Chart>& charts, float step) {
    std::size_t sum = 0;
    for (const Chart& c : charts) {
        const float own = step * wide_factor(c.size);
        sum += std::size_t(texels_along(c.size.x, own)) * std::size_t(texels_along(c.size.y, own));
    }
    return sum;
}

/// The smallest step, within a thousandth, whose texels fit the budget.
float choose_step(const std::vector<Chart>& charts, std::size_t budget) {
    float low = 0.0f, high = 0.0f;
    for (const Chart& c : charts) high = std::max({high, c.size.x, c.size.y});
    high = std::max(high, 1e-6f);
    low = 1e-5f * high;
    while (high > 1.001f * low) {
        const float middle = std::sqrt(low * high);
        (texels_at(charts, middle) <= budget ? high : low) = middle;
    }
    return high;
}

PlacedChart cut(Chart&& chart, float step) {
    PlacedChart placed;
    const float own = step * wide_factor(chart.size);
    placed.nx = texels_along(chart.size.x, own), placed.ny = texels_along(chart.size.y, own);
    placed.step = chart.size / Vec2(float(std::max(placed.nx - 1, 1)), float(std::max(placed.ny - 1, 1)));
    placed.chart = std::move(chart);
    return placed;
}

/// Packs into the given width; the height used, or 0 when it does not fit.
int pack(std::vector<PlacedChart>& charts, int width) {
    std::vector<stbrp_node> nodes(std::size_t(width), stbrp_node{});
    std::vector<stbrp_rect> rects(charts.size());
    for (std::size_t i = 0; i < charts.size(); ++i) {
        rects[i] = {};
        rects[i].id = int(i);
        rects[i].w = charts[i].atlas_width(), rects[i].h = charts[i].atlas_height();
    }
    stbrp_context context;
    stbrp_init_target(&context, width, kMaxSide, nodes.data(), int(nodes.size()));
    if (!stbrp_pack_rects(&context, rects.data(), int(rects.size()))) return 0;
    int height = 1;
    for (const stbrp_rect& r : rects) {
        charts[std::size_t(r.id)].x = r.x, charts[std::size_t(r.id)].y = r.y;
        height = std::max(height, r.y + r.h);
    }
    return height;
}

void place(Atlas& atlas) {
    double area = 0.0;
    int widest = 2;
    for (const PlacedChart& c : atlas.charts) {
        area += double(c.atlas_width()) * c.atlas_height();
        widest = std::max(widest, c.atlas_width());
    }
    atlas.width = std::clamp(int(std::ceil(std::sqrt(area) / 4.0)) * 4, widest, kMaxSide);
    while ((atlas.height = pack(atlas.charts, atlas.width)) == 0) {
        if (atlas.width == kMaxSide) refuse_size();
        atlas.width = std::min(2 * atlas.width, kMaxSide);
    }
}

float inset(float grid, int count) {
    return count == 1 ? 0.5f : std::clamp(grid, kInset, float(count - 1) - kInset);
}

void write_corner_uvs(const WorldMesh& mesh, Atlas& atlas) {
    atlas.chart_of_triangle.assign(mesh.triangle_count(), kNoChart);
    atlas.corner_uvs.assign(3 * mesh.triangle_count(), Vec2(0.0f));
    const Vec2 size(float(atlas.width), float(atlas.height));
    for (std::uint32_t id = 0; id < atlas.charts.size(); ++id) {
        const PlacedChart& c = atlas.charts[id];
        for (std::uint32_t t : c.chart.triangles) {
            atlas.chart_of_triangle[t] = id;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t corner = 3 * std::size_t(t) + k;
                const Vec2 g = c.grid(c.chart.project(mesh.positions[mesh.indices[corner]]));
                atlas.corner_uvs[corner] =
                    Vec2(float(c.x) + 0.5f + inset(g.x, c.nx), float(c.y) + 0.5f + inset(g.y, c.ny)) / size;
            }
        }
    }
}

float grid_along(float plane, float step, int count) {
    if (count == 1) return 0.0f;
    return std::clamp(plane / step, 0.0f, float(count - 1));
}

}  // namespace

Vec2 PlacedChart::grid(const Vec2& plane) const {
    return {grid_along(plane.x, step.x, nx), grid_along(plane.y, step.y, ny)};
}

int PlacedChart::nearest_x(const Vec2& plane) const {
    return int(grid(plane).x + 0.5f);
}

int PlacedChart::nearest_y(const Vec2& plane) const {
    return int(grid(plane).y + 0.5f);
}

Atlas make_atlas(const WorldMesh& mesh, std::size_t texel_budget) {
    if (texel_budget > std::size_t(kMaxSide) * kMaxSide) refuse_size();
    double area = 0.0;
    for (const Facet& f : facets(mesh)) area += f.area;
    const Bounds box = bounds(mesh);
    // Half a texel's width, could all surface be cut evenly; never so fine that a long sliver takes for ever.
    const float extent = box.empty() ? 1.0f : glm::length(box.max - box.min);
    const float grain = std::max(0.5f * float(std::sqrt(area / double(std::max<std::size_t>(texel_budget, 1)))),
                                 std::max(extent / 8192.0f, 1e-9f));
    Atlas atlas;
    std::vector<Chart> charts = grow_charts(mesh, grain);
    const float step = choose_step(charts, texel_budget);
    for (Chart& chart : charts) atlas.charts.push_back(cut(std::move(chart), step));
    place(atlas);
    write_corner_uvs(mesh, atlas);
    return atlas;
}

}  // namespace daylit
