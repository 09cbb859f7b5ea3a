// Charts grow from the largest triangles outwards over edges that are no creases (region growing by normal, as Levy et
// al. 2002 and most atlas makers since do), and are projected along the seed's normal.
#include "gi/surface/charts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "engine/base/random.h"
#include "gi/surface/raster.h"
#include "gi/surface/touching.h"

namespace daylit {
namespace {

constexpr std::uint32_t kNone = ~0u;
constexpr float kMinCosine = 0.8f;  // of a triangle's normal with the seed's: stretch by projection stays below 1.25
constexpr std::size_t kTriedEdges = 48;  // directions tried when a chart is turned into its rectangle
constexpr float kMostDifference = 4.0f;  // of nearness in a chart from its seed's, as a factor
constexpr float kSmooth = 0.9f;  // cosine between shading normals along an edge: else light would bleed round a corner
constexpr float kSmallPiece = 4.0f;  // in area, that may be hidden and nevertheless lie in the chart beside
constexpr float kFlat = 0.996f;  // cosine: without a crease between them, two charts' own noise would show as a seam

/// Vertices at the same place are one vertex, whatever their normals and texture coordinates.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& positions) {
    struct Hash {
        std::size_t operator()(const Vec3& p) const {
            std::uint64_t h = 0;
            for (int axis = 0; axis < 3; ++axis) h = mix64(h ^ std::bit_cast<std::uint32_t>(p[axis] + 0.0f));
            return h;
        }
    };
    std::unordered_map<Vec3, std::uint32_t, Hash> first;
    first.reserve(positions.size());
    std::vector<std::uint32_t> welded(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) welded[i] = first.try_emplace(positions[i], i).first->second;
    return welded;
}

struct Edge {
    std::uint32_t a, b;  // welded vertices, the lower first
    TriangleSide of;
    auto order() const { return std::tie(a, b, of.triangle, of.side); }
    bool same_place(const Edge& o) const { return a == o.a && b == o.b; }
};

std::vector<Edge> sorted_edges(const WorldMesh& mesh, const std::vector<Facet>& facets) {
    const std::vector<std::uint32_t> welded = weld(mesh.positions);
    std::vector<Edge> edges;
    edges.reserve(3 * facets.size());
    for (std::uint32_t t = 0; t < facets.size(); ++t)
        for (std::uint32_t side = 0; facets[t].area > 0.0f && side < 3; ++side) {
            const std::uint32_t p = welded[mesh.indices[3 * std::size_t(t) + side]];
            const std::uint32_t q = welded[mesh.indices[3 * std::size_t(t) + (side + 1) % 3]];
            edges.push_back({std::min(p, q), std::max(p, q), {t, side}});
        }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.order() < b.order(); });
    return edges;
}

/// Whether the surface, as it is shaded, bends sharply along an edge of two triangles: so does its light.
bool crease(const WorldMesh& mesh, const TriangleSide& s, const TriangleSide& t) {
    const auto normal = [&](const TriangleSide& of, std::size_t k) {
        return mesh.normals[mesh.indices[3 * std::size_t(of.triangle) + (of.side + k) % 3]];
    };
    return std::min(glm::dot(normal(s, 0), normal(t, 1)), glm::dot(normal(s, 1), normal(t, 0))) < kSmooth;
}

/// Which triangles lie beside which: across a whole edge that just two share, or in one plane along a piece of one.
class Neighbours {
  public:
    Neighbours(const WorldMesh& mesh, const std::vector<Facet>& facets)
        : across_(facets.size(), {kNone, kNone, kNone}) {
        const std::vector<Edge> edges = sorted_edges(mesh, facets);
        std::vector<TriangleSide> open;
        for (std::size_t i = 0; i < edges.size();) {
            std::size_t end = i + 1;
            while (end < edges.size() && edges[end].same_place(edges[i])) ++end;
            if (end - i == 2 && !crease(mesh, edges[i].of, edges[i + 1].of)) join(edges[i].of, edges[i + 1].of);
            for (; end - i != 2 && i < end; ++i) open.push_back(edges[i].of);
            i = end;
        }
        for (const auto& [a, b] : touching(mesh, facets, open)) pieces_.push_back({a, b}), pieces_.push_back({b, a});
        std::sort(pieces_.begin(), pieces_.end());
    }

    template <class Use>
    void for_each(std::uint32_t triangle, const Use& use) const {
        for (const std::uint32_t next : across_[triangle])
            if (next != kNone) use(next);
        auto piece = std::lower_bound(pieces_.begin(), pieces_.end(), std::array{triangle, 0u});
        for (; piece != pieces_.end() && (*piece)[0] == triangle; ++piece) use((*piece)[1]);
    }

  private:
    void join(const TriangleSide& a, const TriangleSide& b) {
        across_[a.triangle][a.side] = b.triangle, across_[b.triangle][b.side] = a.triangle;
    }

    std::vector<std::array<std::uint32_t, 3>> across_;  // kNone where an edge is open or shared by more than two
    std::vector<std::array<std::uint32_t, 2>> pieces_;  // both ways, sorted
};

/// Two unit vectors that make a right-handed frame with n (Duff et al. 2017).
std::pair<Vec3, Vec3> frame(const Vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
    return {Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3(b, sign + n.y * n.y * a, -n.y)};
}

/// Which cells of every chart's plane are taken, so that a surface that winds over itself is cut where it would.
class TakenCells {
  public:
    explicit TakenCells(float grain) : grain_(grain) {}

    /// Takes the cells whose centres lie inside the triangle; false, and nothing taken, when one was taken before.
    bool take(std::uint32_t chart, const std::array<Vec2, 3>& p) {
        std::array<Vec2, 3> cells;
        for (std::size_t k = 0; k < 3; ++k) cells[k] = p[k] / grain_;
        const Vec2 e = cells[1] - cells[0], f = cells[2] - cells[0];
        const float area = e.x * f.y - e.y * f.x;
        if (!(area > 0.0f)) return false;
        fresh_.clear();
        bool free = true;
        for_cells_inside(cells, 1e-4 * area, [&](long x, long y) {  // cells on a shared edge belong to neither side
            fresh_.push_back({chart, std::int32_t(x), std::int32_t(y)});
            return free = !taken_.count(fresh_.back());
        });
        if (!free) return false;
        taken_.insert(fresh_.begin(), fresh_.end());
        return true;
    }

  private:
    struct Cell {
        std::uint32_t chart;
        std::int32_t x, y;
        bool operator==(const Cell&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Cell& c) const {
            return mix64(mix64(c.chart) ^ (std::uint64_t(std::uint32_t(c.x)) << 32 | std::uint32_t(c.y)));
        }
    };
    float grain_;
    std::unordered_set<Cell, Hash> taken_;
    std::vector<Cell> fresh_;
};

const Vec3& corner(const WorldMesh& mesh, std::uint32_t triangle, std::size_t k) {
    return mesh.positions[mesh.indices[3 * std::size_t(triangle) + k]];
}

struct Edge2 {
    Vec2 direction;  // not normalised
    float square;
};

/// Turns the chart's axes so that its bounding rectangle is small, and moves the origin to that rectangle's corner.
void fit_rectangle(const WorldMesh& mesh, Chart& chart) {
    std::vector<Vec2> points;
    std::vector<Edge2> edges = {{Vec2(1, 0), 0.0f}};
    for (std::uint32_t t : chart.triangles) {
        std::array<Vec2, 3> p;
        for (std::size_t k = 0; k < 3; ++k) points.push_back(p[k] = chart.project(corner(mesh, t, k)));
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 d = p[(k + 1) % 3] - p[k];
            edges.push_back({d, glm::dot(d, d)});
        }
    }
    std::stable_sort(edges.begin() + 1, edges.end(),
                     [](const Edge2& a, const Edge2& b) { return a.square > b.square; });
    edges.resize(std::min(edges.size(), kTriedEdges));

    float best_area = INFINITY;
    Vec2 best_direction(1, 0), best_low(0.0f), best_size(0.0f);
    for (const Edge2& edge : edges) {
        const float length = glm::length(edge.direction);
        if (!(length > 0.0f)) continue;
        const Vec2 u = edge.direction / length, v(-u.y, u.x);
        Vec2 low(INFINITY), high(-INFINITY);
        for (const Vec2& p : points) {
            const Vec2 turned(glm::dot(p, u), glm::dot(p, v));
            low = glm::min(low, turned), high = glm::max(high, turned);
        }
        const float area = (high.x - low.x) * (high.y - low.y);
        if (area < 0.999f * best_area) best_area = area, best_direction = u, best_low = low, best_size = high - low;
    }
    const Vec3 old_u = chart.axis_u, old_v = chart.axis_v;
    chart.axis_u = best_direction.x * old_u + best_direction.y * old_v;
    chart.axis_v = -best_direction.y * old_u + best_direction.x * old_v;
    chart.origin += best_low.x * chart.axis_u + best_low.y * chart.axis_v;
    chart.size = best_size;
}

/// Whether one density of texels serves a triangle and the seed of a chart.
/// cosine   between their normals
/// small    the triangle is: looked at from a point or two, it is found hidden where a part of it is seen
bool alike(const Surroundings& triangle, const Surroundings& seed, float cosine, bool small) {
    if (triangle.hidden != seed.hidden) return triangle.hidden && small && cosine > kFlat;
    const auto [less, more] = std::minmax(triangle.nearness, seed.nearness);
    return cosine > kFlat || more <= kMostDifference * less;
}

}  // namespace

std::vector<Facet> facets(const WorldMesh& mesh) {
    std::vector<Facet> result(mesh.triangle_count());
    for (std::uint32_t t = 0; t < result.size(); ++t) {
        const glm::dvec3 a = corner(mesh, t, 0), b = corner(mesh, t, 1), c = corner(mesh, t, 2);
        const glm::dvec3 n = glm::cross(b - a, c - a);
        const double length = glm::length(n);
        const float area = float(0.5 * length);
        if (std::isfinite(area) && area > 0.0f) result[t] = {area, Vec3(n / length)};
    }
    return result;
}

std::vector<std::uint32_t> smooth_pieces(const WorldMesh& mesh) {
    const Neighbours neighbours(mesh, facets(mesh));
    std::vector<std::uint32_t> piece(mesh.triangle_count(), kNone), found;
    std::uint32_t count = 0;
    for (std::uint32_t seed = 0; seed < piece.size(); ++seed) {
        if (piece[seed] != kNone) continue;
        found.assign(1, seed);
        piece[seed] = count;
        for (std::size_t i = 0; i < found.size(); ++i)
            neighbours.for_each(found[i], [&](std::uint32_t next) {
                if (piece[next] == kNone) piece[next] = count, found.push_back(next);
            });
        ++count;
    }
    return piece;
}

std::vector<Chart> grow_charts(const WorldMesh& mesh, float grain, std::span<const Surroundings> around,
                               const std::vector<bool>& left_out) {
    std::vector<Facet> facet = facets(mesh);
    for (std::size_t t = 0; t < left_out.size(); ++t)
        if (left_out[t]) facet[t] = {};
    const Neighbours neighbours(mesh, facet);
    std::vector<std::uint32_t> seeds(facet.size());
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::stable_sort(seeds.begin(), seeds.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return facet[a].area > facet[b].area; });

    std::vector<Chart> charts;
    std::vector<std::uint32_t> chart_of(facet.size(), kNone);
    TakenCells taken(grain);
    const float texel_area = 4.0f * grain * grain;
    for (std::uint32_t seed : seeds) {
        if (chart_of[seed] != kNone || facet[seed].area <= 0.0f) continue;
        const std::uint32_t id = std::uint32_t(charts.size());
        Chart& chart = charts.emplace_back();
        chart.origin = corner(mesh, seed, 0);
        std::tie(chart.axis_u, chart.axis_v) = frame(facet[seed].normal);
        const auto try_add = [&](std::uint32_t t) {
            if (chart_of[t] != kNone) return;
            const float cosine = glm::dot(facet[t].normal, facet[seed].normal);
            const bool small = facet[t].area <= kSmallPiece * texel_area;
            if (cosine < kMinCosine || (!around.empty() && !alike(around[t], around[seed], cosine, small))) return;
            std::array<Vec2, 3> p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = chart.project(corner(mesh, t, k));
            if (!taken.take(id, p) && t != seed) return;
            chart_of[t] = id;
            chart.triangles.push_back(t);
        };
        try_add(seed);
        for (std::size_t i = 0; i < chart.triangles.size(); ++i) neighbours.for_each(chart.triangles[i], try_add);
        fit_rectangle(mesh, chart);
    }
    return charts;
}

}  // namespace daylit
