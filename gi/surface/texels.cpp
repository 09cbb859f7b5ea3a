#include "gi/surface/texels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/base/vec.h"
#include "gi/surface/raster.h"
#include "gi/transport/path_trace/sampling.h"

namespace daylit {
namespace {

constexpr int kGrid = 4;               // points along each side of a texel
constexpr std::size_t kFewPoints = 4;  // a texel with fewer also takes the centroids of triangles too small to be met

/// The points of one chart, sorted by cell.
using Points = std::vector<TexelPoint>;
struct ChartPoints {
    std::vector<Points> cells;
    std::vector<std::vector<Points>> parts;  // of cells, when they are parted; may be shorter
};

/// From the chart's grid to one of kGrid x kGrid points a texel, with its origin half a texel outside the chart.
Vec2 to_points(const PlacedChart& c, const Vec2& grid) {
    return float(kGrid) * (grid + Vec2(c.nx == 1 ? 0.0f : 0.5f, c.ny == 1 ? 0.0f : 0.5f));
}

/// Weights of the second and third corner at the centre of cell (x, y) of the point grid.
Vec2 barycentric(const std::array<Vec2, 3>& p, long x, long y) {
    const glm::dvec2 e = glm::dvec2(p[1]) - glm::dvec2(p[0]), f = glm::dvec2(p[2]) - glm::dvec2(p[0]);
    const glm::dvec2 d = glm::dvec2(double(x) + 0.5, double(y) + 0.5) - glm::dvec2(p[0]);
    const double area = e.x * f.y - e.y * f.x;
    const double b = std::clamp((d.x * f.y - d.y * f.x) / area, 0.0, 1.0);
    return {float(b), float(std::clamp((e.x * d.y - e.y * d.x) / area, 0.0, 1.0 - b))};
}

ChartPoints chart_points(const Atlas& atlas, const PlacedChart& c) {
    ChartPoints result;
    result.cells.resize(std::size_t(c.nx) * std::size_t(c.ny));
    std::vector<bool> taken(result.cells.size() * kGrid * kGrid, false);
    std::vector<std::uint32_t> missed;
    for (std::uint32_t t : c.chart.triangles) {
        std::array<Vec2, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = to_points(c, atlas.corner_grids[3 * std::size_t(t) + k]);
        bool met = false;
        for_cells_inside(counter_clockwise(p), 0.0, [&](long x, long y) {
            const long cx = x / kGrid, cy = y / kGrid;
            if (x < 0 || y < 0 || cx >= c.nx || cy >= c.ny) return true;
            const std::size_t sub = std::size_t(y) * std::size_t(c.nx) * kGrid + std::size_t(x);
            met = true;
            if (!taken[sub]) {
                taken[sub] = true;
                result.cells[std::size_t(cy) * std::size_t(c.nx) + std::size_t(cx)].push_back(
                    {t, barycentric(p, x, y)});
            }
            return true;
        });
        if (!met) missed.push_back(t);
    }
    for (std::uint32_t t : missed) {
        const TexelPoint centroid{t, Vec2(1.0f / 3.0f)};
        const Vec2 grid = atlas.grid(t, centroid.barycentric);
        auto& cell = result.cells[std::size_t(c.nearest_y(grid)) * std::size_t(c.nx) + std::size_t(c.nearest_x(grid))];
        if (cell.size() < kFewPoints) cell.push_back(centroid);
    }
    return result;
}

/// Points of the same number, in their order.
std::vector<Points> by_number(const Points& points, const std::vector<int>& numbers) {
    std::vector<Points> parts(std::size_t(*std::max_element(numbers.begin(), numbers.end())) + 1);
    for (std::size_t i = 0; i < points.size(); ++i) parts[std::size_t(numbers[i])].push_back(points[i]);
    return parts;
}

/// Unit; zero where the triangle has no area in the grid.
Vec3 growth_of_u(const WorldMesh& mesh, const Atlas& atlas, std::uint32_t triangle) {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(triangle)];
    const Vec2* grid = &atlas.corner_grids[3 * std::size_t(triangle)];
    const glm::dvec3 a = mesh.positions[corner[0]], e = glm::dvec3(mesh.positions[corner[1]]) - a,
                     f = glm::dvec3(mesh.positions[corner[2]]) - a;
    const glm::dvec2 d = grid[1] - grid[0], g = grid[2] - grid[0];
    const double twice = d.x * g.y - d.y * g.x;
    if (twice == 0.0) return Vec3(0.0f);
    return unit_or(Vec3((twice < 0.0 ? -1.0 : 1.0) * (g.y * e - d.y * f)), Vec3(0.0f));
}

void add_texel(const WorldMesh& mesh, const Atlas& atlas, const Points& points, std::uint32_t chart, std::uint32_t cell,
               float width, Texels& texels) {
    Vec3 place(0.0f), normal(0.0f), along_u(0.0f);
    for (const TexelPoint& p : points) {
        place += position(mesh, p) / float(points.size());
        normal += geometric_normal(mesh, p.triangle);
        along_u += growth_of_u(mesh, atlas, p.triangle);
    }
    normal = unit_or(normal, geometric_normal(mesh, points.front().triangle));
    const auto id = std::uint32_t(texels.count());
    if (texels.texel_of_cell[cell] == kNoTexel)
        texels.texel_of_cell[cell] = id;
    else
        texels.next_part.back() = id;  // parts of a cell follow one another
    texels.next_part.push_back(kNoTexel);
    texels.chart.push_back(chart);
    texels.cell.push_back(cell);
    texels.position.push_back(place);
    texels.normal.push_back(normal);
    texels.along_u.push_back(unit_or(along_u - glm::dot(along_u, normal) * normal, Frame(normal).x));
    texels.width.push_back(width);
    texels.points.insert(texels.points.end(), points.begin(), points.end());
    texels.first_point.push_back(std::uint32_t(texels.points.size()));
}

void fill_nearest(const Atlas& atlas, Texels& texels) {
    texels.nearest_texel_of_cell = texels.texel_of_cell;
    tbb::parallel_for(std::size_t(0), atlas.charts.size(), [&](std::size_t id) {
        const PlacedChart& c = atlas.charts[id];
        const std::uint32_t first = texels.first_cell[id], count = texels.first_cell[id + 1] - first;
        std::vector<bool> usable(count);
        for (std::uint32_t i = 0; i < count; ++i) usable[i] = texels.texel_of_cell[first + i] != kNoTexel;
        const std::vector<std::uint32_t> nearest = nearest_usable(c.nx, c.ny, usable);
        for (std::uint32_t i = 0; i < count; ++i)
            texels.nearest_texel_of_cell[first + i] = texels.texel_of_cell[first + nearest[i]];
    });
}

}  // namespace

float texel_width(const PlacedChart& c) {
    return std::sqrt(std::max(c.step.x, 1e-9f) * std::max(c.step.y, 1e-9f));
}

Vec3 position(const WorldMesh& mesh, const TexelPoint& point) {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(point.triangle)];
    const Vec2 b = point.barycentric;
    return mesh.positions[corner[0]] * (1.0f - b.x - b.y) + mesh.positions[corner[1]] * b.x +
           mesh.positions[corner[2]] * b.y;
}

Vec3 geometric_normal(const WorldMesh& mesh, std::uint32_t triangle) {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(triangle)];
    const glm::dvec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
    return Vec3(glm::normalize(glm::cross(b - a, c - a)));
}

std::vector<std::uint32_t> nearest_usable(int nx, int ny, const std::vector<bool>& usable) {
    std::vector<std::uint32_t> nearest(usable.size(), kNoTexel), queue;
    for (std::uint32_t i = 0; i < usable.size(); ++i)
        if (usable[i]) nearest[i] = i, queue.push_back(i);
    for (std::size_t head = 0; head < queue.size(); ++head) {
        const int x = int(queue[head]) % nx, y = int(queue[head]) / nx;
        const auto spread = [&](int to_x, int to_y) {
            if (to_x < 0 || to_y < 0 || to_x >= nx || to_y >= ny) return;
            const std::uint32_t to = std::uint32_t(to_y * nx + to_x);
            if (nearest[to] == kNoTexel) nearest[to] = nearest[queue[head]], queue.push_back(to);
        };
        spread(x, y - 1), spread(x - 1, y), spread(x + 1, y), spread(x, y + 1);
    }
    return nearest;
}

std::vector<bool> away_from(const Atlas& atlas, const Texels& texels, const std::vector<bool>& marked) {
    std::vector<bool> away(texels.count());
    for (std::uint32_t t = 0; t < texels.count(); ++t) {
        bool near = false;
        for_texels_around(atlas, texels, t, 1, [&](std::uint32_t other) {
            texels.for_parts(other, [&](std::uint32_t part) { near = near || marked[part]; });
        });
        away[t] = !near;
    }
    return away;
}

std::uint32_t Texels::at(const Atlas& atlas, std::uint32_t triangle, const Vec2& barycentric) const {
    const std::uint32_t id = atlas.chart_of_triangle[triangle];
    if (id == kNoChart) return kNoTexel;
    const PlacedChart& c = atlas.charts[id];
    const Vec2 grid = atlas.grid(triangle, barycentric);
    const std::uint32_t first =
        nearest_texel_of_cell[first_cell[id] + std::uint32_t(c.nearest_y(grid) * c.nx + c.nearest_x(grid))];
    if (next_part[first] == kNoTexel) return first;
    std::uint32_t nearest = first;
    float least = 1e30f;
    for_parts(first, [&](std::uint32_t part) {
        for (const TexelPoint& p : points_of(part)) {
            const float away = glm::distance(atlas.grid(p.triangle, p.barycentric), grid);
            if (away < least) least = away, nearest = part;
        }
    });
    return nearest;
}

Texels make_texels(const WorldMesh& mesh, const Atlas& atlas, const PointParting& part) {
    std::vector<ChartPoints> charts(atlas.charts.size());
    tbb::parallel_for(std::size_t(0), charts.size(), [&](std::size_t id) {
        ChartPoints& chart = charts[id] = chart_points(atlas, atlas.charts[id]);
        for (std::size_t i = 0; part && i < chart.cells.size(); ++i) {
            if (chart.cells[i].empty()) continue;
            const std::vector<int> numbers = part(chart.cells[i], texel_width(atlas.charts[id]));
            if (std::all_of(numbers.begin(), numbers.end(), [](int n) { return n == 0; })) continue;
            chart.parts.resize(i + 1);
            chart.parts[i] = by_number(chart.cells[i], numbers);
        }
    });
    Texels texels;
    texels.first_point.push_back(0);
    for (std::uint32_t id = 0; id < charts.size(); ++id) {
        const PlacedChart& c = atlas.charts[id];
        const std::uint32_t first = std::uint32_t(texels.texel_of_cell.size());
        texels.first_cell.push_back(first);
        texels.texel_of_cell.resize(first + charts[id].cells.size(), kNoTexel);
        for (std::uint32_t i = 0; i < charts[id].cells.size(); ++i) {
            if (i < charts[id].parts.size() && !charts[id].parts[i].empty())
                for (const Points& part_points : charts[id].parts[i])
                    add_texel(mesh, atlas, part_points, id, first + i, texel_width(c), texels);
            else if (!charts[id].cells[i].empty())
                add_texel(mesh, atlas, charts[id].cells[i], id, first + i, texel_width(c), texels);
        }
    }
    texels.first_cell.push_back(std::uint32_t(texels.texel_of_cell.size()));
    fill_nearest(atlas, texels);
    return texels;
}

}  // namespace daylit
