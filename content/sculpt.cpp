#include "content/sculpt.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace daylit::content {
namespace {

float lump_distance(const Lump& lump, Vec3 p) {
    // A squashed lump is measured in its own unsquashed space; the least scale keeps the value a lower bound.
    p = lump.from + (p - lump.from) / lump.squash;
    const Vec3 axis = (lump.to - lump.from) / lump.squash;
    const float scale = std::min({lump.squash.x, lump.squash.y, lump.squash.z});
    const float length = glm::length(axis);
    const Vec3 q = p - lump.from;
    if (length < 1e-6f) return (glm::length(q) - lump.radius_from) * scale;
    const Vec3 d = axis / length;
    const float along = glm::dot(q, d), across = glm::length(q - d * along);
    const float b = (lump.radius_from - lump.radius_to) / length;
    const float a = std::sqrt(std::max(1.0f - b * b, 0.0f));
    const float k = -b * across + a * along;  // where the tangent cone's normal through p meets the axis
    if (k < 0.0f) return (glm::length(q) - lump.radius_from) * scale;
    if (k > a * length) return (glm::length(p - lump.from - axis) - lump.radius_to) * scale;
    return (across * a + along * b - lump.radius_from) * scale;
}

// Polynomial smooth minimum (Quilez).
float smooth_min(float a, float b, float k) {
    if (k <= 0.0f) return std::min(a, b);
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}

struct Grid {
    Vec3 low;
    float cell;
    int nx, ny, nz;
    std::vector<float> values;
    std::size_t index(int x, int y, int z) const {
        return (std::size_t(y) * std::size_t(nz) + std::size_t(z)) * std::size_t(nx) + std::size_t(x);
    }
    Vec3 point(int x, int y, int z) const { return low + cell * Vec3(x, y, z); }
};

Grid sample(const Sculpture& s, float cell) {
    Vec3 low(1e30f), high(-1e30f);
    for (const Lump& l : s.lumps) {
        const float r = std::max(l.radius_from, l.radius_to) + l.blend + 2.0f * cell;
        const Vec3 end = l.to;
        const Vec3 reach = r * glm::max(l.squash, Vec3(1.0f));
        low = glm::min(low, glm::min(l.from, end) - reach);
        high = glm::max(high, glm::max(l.from, end) + reach);
    }
    const Vec3 size = (high - low) / cell;
    Grid g{low, cell, int(size.x) + 2, int(size.y) + 2, int(size.z) + 2, {}};
    g.values.resize(std::size_t(g.nx) * std::size_t(g.ny) * std::size_t(g.nz));
    tbb::parallel_for(0, g.ny, [&](int y) {
        for (int z = 0; z < g.nz; ++z)
            for (int x = 0; x < g.nx; ++x) g.values[g.index(x, y, z)] = s.distance(g.point(x, y, z));
    });
    return g;
}

Vec3 gradient(const Sculpture& s, const Vec3& p, float e) {
    const Vec3 g(s.distance(p + Vec3(e, 0, 0)) - s.distance(p - Vec3(e, 0, 0)),
                 s.distance(p + Vec3(0, e, 0)) - s.distance(p - Vec3(0, e, 0)),
                 s.distance(p + Vec3(0, 0, e)) - s.distance(p - Vec3(0, 0, e)));
    const float l = glm::length(g);
    return l > 1e-9f ? g / l : Vec3(0, 1, 0);
}

int nearest_material(const Sculpture& s, const Vec3& p) {
    float best = std::numeric_limits<float>::max();
    int material = 0;
    for (const Lump& l : s.lumps) {
        const float d = lump_distance(l, p);
        if (d < best) best = d, material = l.material;
    }
    return material;
}

// The four nearest joints, weighted so that influence falls with distance beyond the nearest.
void skin_vertex(const Sculpture& s, const Vec3& p, std::array<std::uint16_t, 4>& joints, Vec4& weights) {
    int count = 0;
    for (const Lump& l : s.lumps) count = std::max(count, l.joint + 1);
    std::vector<std::pair<float, int>> near;
    for (int j = 0; j < count; ++j) near.emplace_back(std::numeric_limits<float>::max(), j);
    for (const Lump& l : s.lumps) {
        float& d = near[std::size_t(l.joint)].first;
        d = std::min(d, lump_distance(l, p));
    }
    std::sort(near.begin(), near.end());
    float total = 0.0f;
    for (int i = 0; i < 4; ++i) {
        const bool present = i < count && near[std::size_t(i)].first < 1e30f;
        const float away = present ? std::max(near[std::size_t(i)].first - near[0].first, 0.0f) : 1.0f;
        weights[i] = present ? std::exp(-away / 0.025f) : 0.0f;
        joints[std::size_t(i)] = std::uint16_t(present ? near[std::size_t(i)].second : 0);
        total += weights[i];
    }
    weights /= total;
}

}  // namespace

float Sculpture::distance(const Vec3& p) const {
    float d = std::numeric_limits<float>::max();
    for (const Lump& l : lumps) {
        const float own = lump_distance(l, p);
        d = d == std::numeric_limits<float>::max() ? own : smooth_min(d, own, l.blend);
    }
    return d;
}

LevelMesh polygonise(const Sculpture& s, float cell, const std::vector<int>& materials, bool skinned,
                     const std::string& name) {
    const Grid g = sample(s, cell);
    // One vertex in each cell that the surface crosses.
    std::vector<int> vertex_of(g.values.size(), -1);
    std::vector<Vec3> points;
    for (int y = 0; y + 1 < g.ny; ++y)
        for (int z = 0; z + 1 < g.nz; ++z)
            for (int x = 0; x + 1 < g.nx; ++x) {
                Vec3 sum(0.0f);
                int crossings = 0;
                for (int edge = 0; edge < 12; ++edge) {
                    const int axis = edge / 4, u = edge & 1, v = edge >> 1 & 1;
                    std::array<int, 3> a = {x, y, z};
                    a[std::size_t((axis + 1) % 3)] += u;
                    a[std::size_t((axis + 2) % 3)] += v;
                    std::array<int, 3> b = a;
                    ++b[std::size_t(axis)];
                    const float da = g.values[g.index(a[0], a[1], a[2])], db = g.values[g.index(b[0], b[1], b[2])];
                    if ((da < 0.0f) == (db < 0.0f)) continue;
                    const Vec3 pa = g.point(a[0], a[1], a[2]), pb = g.point(b[0], b[1], b[2]);
                    sum += pa + (pb - pa) * (da / (da - db));
                    ++crossings;
                }
                if (crossings == 0) continue;
                vertex_of[g.index(x, y, z)] = int(points.size());
                points.push_back(sum / float(crossings));
            }
    std::vector<Vec3> normals(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        Vec3& p = points[i];
        normals[i] = gradient(s, p, 0.5f * cell);
        const float off = s.distance(p);
        p -= normals[i] * std::clamp(off, -0.4f * cell, 0.4f * cell);
        normals[i] = gradient(s, p, 0.5f * cell);
    });

    LevelMesh mesh;
    mesh.name = name;
    std::vector<std::map<int, std::uint32_t>> placed(points.size());
    const auto place = [&](int v, int material) {
        Geometry& part = mesh.parts[material];
        const auto [entry, fresh] = placed[std::size_t(v)].try_emplace(material, std::uint32_t(part.positions.size()));
        if (fresh) {
            const Vec3& p = points[std::size_t(v)];
            part.positions.push_back(p);
            part.normals.push_back(normals[std::size_t(v)]);
            part.uvs.emplace_back(p.x + p.z, -p.y);
            if (skinned) {
                part.joints.emplace_back();
                part.weights.emplace_back();
                skin_vertex(s, p, part.joints.back(), part.weights.back());
            }
        }
        return entry->second;
    };
    // One quad around each grid edge with a sign change.
    for (int y = 1; y + 1 < g.ny; ++y)
        for (int z = 1; z + 1 < g.nz; ++z)
            for (int x = 1; x + 1 < g.nx; ++x)
                for (int axis = 0; axis < 3; ++axis) {
                    std::array<int, 3> next = {x, y, z};
                    ++next[std::size_t(axis)];
                    const bool inside = g.values[g.index(x, y, z)] < 0.0f;
                    if (inside == (g.values[g.index(next[0], next[1], next[2])] < 0.0f)) continue;
                    std::array<int, 4> q{};
                    for (int k = 0; k < 4; ++k) {
                        std::array<int, 3> c = {x, y, z};
                        if (k == 1 || k == 2) --c[std::size_t((axis + 1) % 3)];
                        if (k >= 2) --c[std::size_t((axis + 2) % 3)];
                        q[std::size_t(k)] = vertex_of[g.index(c[0], c[1], c[2])];
                    }
                    if (!inside) std::swap(q[1], q[3]);
                    Vec3 middle(0.0f);
                    for (int v : q) middle += 0.25f * points[std::size_t(v)];
                    const int material = materials[std::size_t(nearest_material(s, middle))];
                    std::array<std::uint32_t, 4> v{};
                    for (std::size_t k = 0; k < 4; ++k) v[k] = place(q[k], material);
                    auto& indices = mesh.parts[material].indices;
                    indices.insert(indices.end(), {v[0], v[1], v[2], v[0], v[2], v[3]});
                }
    return mesh;
}

}  // namespace daylit::content
