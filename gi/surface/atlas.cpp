#include "gi/surface/atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/error.h"
#include "gi/surface/pack.h"

namespace daylit {
namespace {

constexpr int kMaxChartSide = 2048;

// Light varies along a surface the faster the nearer the surroundings are: its relative gradient is bounded by the mean
// inverse distance of what is seen (Ward and Heckbert 1992), and along an axis it goes with how fast that changes. And
// the faster the surface turns: by up to its own size a radian.
// Steps go with the fourth root of that rate. Least error relative to local brightness would ask for the square root,
// but that starves open ground, where most light is and whose shadows the mean distance does not know.
constexpr float kPower = 0.25f;
constexpr float kWidestRange = 4.0f;  // of steps, to either side of the mean
constexpr float kLongest = 8.0f;      // a texel, times its width
constexpr float kHiddenStep = 16.0f;  // of charts where nobody can look, times the mean
constexpr float kWideArea = 100.0f;   // square metres: larger charts get coarser, with the eighth root of their area
// Fetches keep this far, in texels, inside the outermost texel centres: well over the 1/256 of a GPU's fixed-point
// filter, and beyond what coordinates in 16 bits are rounded by. A neighbour in the atlas may be 1e5 times as bright.
constexpr float kInset = 1.0f / 64.0f;
constexpr float kInFront = 0.25f;               // of a chart's width, where it counts as lying
constexpr float kUvRounding = 0.5f / 65535.0f;  // of the atlas's side

int texels_along(float size, float step) {
    return std::clamp(1 + int(std::min(size / step + 0.5f, 1e6f)), 1, kMaxChartSide);
}

/// A chart and how large its texels are beside those of the others.
struct Share {
    Chart chart;
    Vec2 factor = Vec2(1.0f);  // of the step, along axis_u and axis_v
    int nx(float step) const { return texels_along(chart.size.x, step * factor.x); }
    int ny(float step) const { return texels_along(chart.size.y, step * factor.y); }
};

/// Sums over the area of triangles that are not hidden.
struct AroundSum {
    double area = 0.0, nearness = 0.0;
    glm::dmat3 change = glm::dmat3(0.0);
    void add(const Facet& facet, const Surroundings& around) {
        if (around.hidden) return;
        area += facet.area;
        nearness += double(facet.area) * around.nearness;
        change += double(facet.area) * glm::dmat3(around.change);
    }
    /// How fast light may vary along an axis, per metre.
    float rate(const Vec3& axis) const {
        if (nearness == 0.0) return 0.0f;
        const double along = glm::dot(glm::dvec3(axis), change * glm::dvec3(axis));
        return float(nearness / area + along / nearness);
    }
};

/// How fast the shading normal turns along a direction, radians a metre, averaged over a chart's area.
float turning(const WorldMesh& mesh, const Chart& chart, std::span<const Facet> facet, const Vec3& direction) {
    double area = 0.0, sum = 0.0;
    for (const std::uint32_t t : chart.triangles) {
        const std::uint32_t* corner = &mesh.indices[3 * std::size_t(t)];
        Vec3 change(0.0f);
        for (int k = 0; k < 3; ++k) {
            // The gradient of a corner's weight: across the edge that faces it, over the height above that edge.
            const Vec3 edge = mesh.positions[corner[(k + 2) % 3]] - mesh.positions[corner[(k + 1) % 3]];
            change += mesh.normals[corner[k]] * glm::dot(glm::cross(facet[t].normal, edge), direction);
        }
        sum += 0.5 * double(glm::length(change));  // over twice the area, times the area
        area += facet[t].area;
    }
    return area > 0.0 ? float(sum / area) : 0.0f;
}

Vec2 step_factor(const Chart& chart, const AroundSum& own, const Vec2& turning, float mean_rate) {
    if (own.area == 0.0) return Vec2(kHiddenStep);
    if (mean_rate == 0.0f) return Vec2(1.0f);
    constexpr float kLeast = 1e-6f;
    const float u = std::max((own.rate(chart.axis_u) + turning.x) / mean_rate, kLeast);
    const float v = std::max((own.rate(chart.axis_v) + turning.y) / mean_rate, kLeast);
    const float size = std::clamp(std::pow(u * v, -0.5f * kPower), 1.0f / kWidestRange, kWidestRange);
    const float shape = std::sqrt(std::clamp(v / u, 1.0f / kLongest, kLongest));
    return size * Vec2(shape, 1.0f / shape);
}

std::vector<Share> share_out(const WorldMesh& mesh, std::vector<Chart>&& charts, std::span<const Surroundings> around) {
    const std::vector<Facet> facet = facets(mesh);
    AroundSum all;
    for (std::size_t t = 0; t < around.size(); ++t) all.add(facet[t], around[t]);
    const float mean_rate = all.area > 0.0 ? float(all.nearness / all.area) : 0.0f;
    std::vector<Share> shares;
    for (Chart& chart : charts) {
        Vec2 factor(std::max(1.0f, std::pow(chart.size.x * chart.size.y / kWideArea, 0.125f)));
        if (!around.empty()) {
            AroundSum own;
            for (std::uint32_t t : chart.triangles) own.add(facet[t], around[t]);
            const Vec2 turns(turning(mesh, chart, facet, chart.axis_u), turning(mesh, chart, facet, chart.axis_v));
            factor *= step_factor(chart, own, turns, mean_rate);
        }
        shares.push_back({std::move(chart), factor});
    }
    return shares;
}

/// Texels of a kept layout: two at least along each side, so that a fetch between them stays inside.
glm::ivec2 texels_of(const KeptLayout& layout, float step) {
    if (layout.texels) return glm::max(*layout.texels, 2);
    const auto along = [&](float size) {
        return std::clamp(int(std::min(size / step + 0.5f, 1e6f)), 2, kMaxAtlasSide);
    };
    return {along(layout.metres.x), along(layout.metres.y)};
}

std::size_t texels_at(const std::vector<Share>& shares, const std::vector<KeptLayout>& kept, float step) {
    std::size_t sum = 0;
    for (const Share& s : shares) sum += std::size_t(s.nx(step)) * std::size_t(s.ny(step));
    for (const KeptLayout& k : kept) sum += std::size_t(texels_of(k, step).x) * std::size_t(texels_of(k, step).y);
    return sum;
}

/// The smallest step, within a thousandth, whose texels fit the budget.
float choose_step(const std::vector<Share>& shares, const std::vector<KeptLayout>& kept, std::size_t budget) {
    float low = 0.0f, high = 0.0f;
    for (const KeptLayout& k : kept) high = std::max({high, k.metres.x, k.metres.y});
    for (const Share& s : shares) high = std::max({high, s.chart.size.x / s.factor.x, s.chart.size.y / s.factor.y});
    high = std::max(4.0f * high, 1e-6f);  // where every chart is one texel
    low = 1e-5f * high;
    while (high > 1.001f * low) {
        const float middle = std::sqrt(low * high);
        (texels_at(shares, kept, middle) <= budget ? high : low) = middle;
    }
    return high;
}

PlacedChart cut(Share&& share, float step) {
    PlacedChart placed;
    placed.nx = share.nx(step), placed.ny = share.ny(step);
    const Vec2 steps(float(std::max(placed.nx - 1, 1)), float(std::max(placed.ny - 1, 1)));
    placed.step = share.chart.size / steps;
    placed.chart = std::move(share.chart);
    return placed;
}

/// In front of a chart, so that the two sides of a wall are apart.
Block block_of(const PlacedChart& placed) {
    const Chart& chart = placed.chart;
    const Vec3 middle = chart.origin + 0.5f * (chart.size.x * chart.axis_u + chart.size.y * chart.axis_v);
    const float away = kInFront * std::sqrt(chart.size.x * chart.size.y);
    return {placed.atlas_width(), placed.atlas_height(), middle + away * glm::cross(chart.axis_u, chart.axis_v)};
}

/// Its islands as charts whose texels are those of the layout. block: where the layout lies
void add_kept(const WorldMesh& mesh, const KeptLayout& layout, const Block& block, Atlas& atlas) {
    const glm::ivec2 texels(block.width, block.height);
    for (const Chart& island : layout.islands) {
        PlacedChart placed;
        placed.chart = island;
        placed.step = layout.metres / Vec2(texels);
        Vec2 low(INFINITY), high(-INFINITY);
        for (const std::uint32_t t : island.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t corner = 3 * std::size_t(t) + k;
                const Vec2 share = (mesh.uvs[mesh.indices[corner]][1] - layout.low) / layout.size;
                const Vec2 grid = glm::clamp(share * Vec2(texels) - 0.5f, Vec2(0.0f), Vec2(texels - 1));
                atlas.corner_grids[corner] = grid;
                low = glm::min(low, grid), high = glm::max(high, grid);
            }
        const glm::ivec2 first = glm::min(glm::ivec2(low), texels - 2);
        const glm::ivec2 last = glm::max(glm::ivec2(glm::ceil(high)), first + 1);
        for (const std::uint32_t t : island.triangles)
            for (std::size_t k = 0; k < 3; ++k) atlas.corner_grids[3 * std::size_t(t) + k] -= Vec2(first);
        placed.nx = last.x - first.x + 1, placed.ny = last.y - first.y + 1;
        placed.x = block.x + first.x, placed.y = block.y + first.y;
        atlas.charts.push_back(std::move(placed));
    }
}

float grid_along(float plane, float step, int count) {
    return step > 0.0f ? std::clamp(plane / step, 0.0f, float(std::max(count - 1, 1))) : 0.0f;
}

void add_unwrapped(const WorldMesh& mesh, PlacedChart&& placed, const Block& block, Atlas& atlas) {
    placed.x = block.x, placed.y = block.y;
    for (const std::uint32_t t : placed.chart.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t corner = 3 * std::size_t(t) + k;
            const Vec2 plane = placed.chart.project(mesh.positions[mesh.indices[corner]]);
            atlas.corner_grids[corner] = {grid_along(plane.x, placed.step.x, placed.nx),
                                          grid_along(plane.y, placed.step.y, placed.ny)};
        }
    atlas.charts.push_back(std::move(placed));
}

/// Of a single texel, whose copy follows, anywhere between the two: it keeps its area for whoever reads the layout.
/// side: of the atlas, texels
float inset(float grid, int count, int side) {
    const float rim = kInset + kUvRounding * float(side);
    return std::clamp(grid, rim, float(std::max(count - 1, 1)) - rim);
}

void write_corner_uvs(Atlas& atlas) {
    const Vec2 size(float(atlas.width), float(atlas.height));
    for (std::uint32_t id = 0; id < atlas.charts.size(); ++id) {
        const PlacedChart& c = atlas.charts[id];
        for (const std::uint32_t t : c.chart.triangles) {
            atlas.chart_of_triangle[t] = id;
            for (std::size_t corner = 3 * std::size_t(t); corner < 3 * std::size_t(t) + 3; ++corner) {
                const Vec2& g = atlas.corner_grids[corner];
                atlas.corner_uvs[corner] = Vec2(float(c.x) + 0.5f + inset(g.x, c.nx, atlas.width),
                                                float(c.y) + 0.5f + inset(g.y, c.ny, atlas.height)) /
                                           size;
            }
        }
    }
}

/// A size that the file asks for is kept where the budget does not forbid it, else its shape alone.
std::vector<KeptLayout> within_budget(std::vector<KeptLayout> layouts, std::size_t budget) {
    constexpr std::size_t kMostTimes = 4;
    for (KeptLayout& layout : layouts) {
        if (!layout.texels) continue;
        const Vec2 texels(*layout.texels);
        if (std::size_t(layout.texels->x) * std::size_t(layout.texels->y) <= kMostTimes * budget) continue;
        layout.texels.reset();
        layout.metres = texels * std::sqrt(layout.metres.x * layout.metres.y / (texels.x * texels.y));
    }
    return layouts;
}

}  // namespace

float even_step(const WorldMesh& mesh, std::size_t texel_budget) {
    if (texel_budget > std::size_t(kMaxAtlasSide) * kMaxAtlasSide) refuse_atlas_size();
    double area = 0.0;
    for (const Facet& f : facets(mesh)) area += f.area;
    return float(std::sqrt(area / double(std::max<std::size_t>(texel_budget, 1))));
}

Atlas make_atlas(const WorldMesh& mesh, std::size_t texel_budget, std::span<const Surroundings> around,
                 const KeptLayouts& kept) {
    const Bounds box = bounds(mesh);
    // Half a texel's width; never so fine that a long sliver takes for ever.
    const float extent = box.empty() ? 1.0f : glm::length(box.max - box.min);
    const float grain = std::max(0.5f * even_step(mesh, texel_budget), std::max(extent / 8192.0f, 1e-9f));
    std::vector<Share> shares = share_out(mesh, grow_charts(mesh, grain, around, kept.kept), around);
    const std::vector<KeptLayout> layouts = within_budget(kept.layouts, texel_budget);
    const float step = choose_step(shares, layouts, texel_budget);

    std::vector<PlacedChart> unwrapped;
    std::vector<Block> blocks;
    for (const KeptLayout& k : layouts) {
        const glm::ivec2 texels = texels_of(k, step);
        blocks.push_back({texels.x, texels.y, k.islands.empty() ? Vec3(0.0f) : k.islands[0].origin});
    }
    for (Share& share : shares) {
        unwrapped.push_back(cut(std::move(share), step));
        blocks.push_back(block_of(unwrapped.back()));
    }
    Atlas atlas;
    const PackedSize size = pack(blocks);
    atlas.width = size.width, atlas.height = size.height;
    atlas.chart_of_triangle.assign(mesh.triangle_count(), kNoChart);
    atlas.corner_grids.assign(3 * mesh.triangle_count(), Vec2(0.0f));
    atlas.corner_uvs = atlas.corner_grids;
    for (std::size_t i = 0; i < layouts.size(); ++i) add_kept(mesh, layouts[i], blocks[i], atlas);
    for (std::size_t i = 0; i < unwrapped.size(); ++i)
        add_unwrapped(mesh, std::move(unwrapped[i]), blocks[layouts.size() + i], atlas);
    write_corner_uvs(atlas);
    return atlas;
}

}  // namespace daylit
