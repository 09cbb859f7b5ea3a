#include "gi/surface/kept_layout.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <unordered_map>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "gi/surface/raster.h"

namespace daylit {
namespace {

constexpr float kBeyond = 1e-4f;  // by which coordinates may leave 0 to 1: rounding
constexpr int kCells = 2048;      // of the grid on which overlaps are looked for, along a side
// Cells of a mesh that may be covered twice: seams that touch.
constexpr std::size_t kTolerated = 2, kToleratedShare = 1000;

class Coordinates {
  public:
    explicit Coordinates(const WorldMesh& mesh) : mesh_(mesh) {}

    Vec2 uv(std::size_t triangle, std::size_t k) const { return glm::clamp(raw(triangle, k), Vec2(0.0f), Vec2(1.0f)); }
    const Vec2& raw(std::size_t triangle, std::size_t k) const { return mesh_.uvs[mesh_.indices[3 * triangle + k]][1]; }
    glm::dvec3 place(std::size_t triangle, std::size_t k) const {
        return mesh_.positions[mesh_.indices[3 * triangle + k]];
    }

  private:
    const WorldMesh& mesh_;
};

/// How a piece of surface lies in the layout; lengths of a unit of u and of v are weighted by area in the layout.
struct Stretch {
    double world_area = 0.0, layout_area = 0.0, along_u = 0.0, along_v = 0.0;

    void add(const Coordinates& at, std::size_t t) {
        const glm::dvec3 e = at.place(t, 1) - at.place(t, 0), f = at.place(t, 2) - at.place(t, 0);
        const glm::dvec2 d = at.uv(t, 1) - at.uv(t, 0), g = at.uv(t, 2) - at.uv(t, 0);
        world_area += 0.5 * glm::length(glm::cross(e, f)), layout_area += 0.5 * std::abs(d.x * g.y - d.y * g.x);
        along_u += glm::length(g.y * e - d.y * f), along_v += glm::length(d.x * f - g.x * e);
    }
    /// Metres for a unit of u and of v.
    Vec2 scale() const {
        const double scale = std::sqrt(world_area / layout_area), shape = std::sqrt(along_u / along_v);
        return Vec2(float(scale * shape), float(scale / shape));
    }
};

std::string name_of(const Scene& scene, const PlacedMesh& placed) {
    const int mesh = scene.nodes[std::size_t(placed.node)].mesh;
    const std::string& name = scene.meshes[std::size_t(mesh)].name;
    return "mesh " + std::to_string(mesh) + (name.empty() ? "" : " '" + name + "'");
}

void check_range(const Scene& scene, const PlacedMesh& placed, const Coordinates& at) {
    for (std::size_t t = placed.first_triangle; t < placed.first_triangle + placed.triangles; ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2& uv = at.raw(t, k);
            if (glm::all(glm::greaterThanEqual(uv, Vec2(-kBeyond))) &&
                glm::all(glm::lessThanEqual(uv, Vec2(1 + kBeyond))))
                continue;
            char text[160];
            std::snprintf(text, sizeof text,
                          "has TEXCOORD_1 at (%g, %g), outside 0 to 1; lay it out anew or bake without --keep-uv2",
                          double(uv.x), double(uv.y));
            throw Error(name_of(scene, placed), text);
        }
}

/// throws Error when it lies outside of 0 to 1.
bool has_layout(const Scene& scene, const PlacedMesh& placed, const Coordinates& at) {
    for (const Primitive& p : scene.meshes[std::size_t(scene.nodes[std::size_t(placed.node)].mesh)].primitives)
        if (p.topology == Topology::Triangles && p.uvs.size() < 2) return false;
    check_range(scene, placed, at);
    Stretch all;
    for (std::size_t t = placed.first_triangle; t < placed.first_triangle + placed.triangles; ++t) all.add(at, t);
    return all.layout_area > 0.0;
}

/// A grid over 0 to 1, each cell with the triangle seen last.
class Cover {
  public:
    /// Whether another mesh was met. throws Error when the mesh covers itself.
    bool add(const Scene& scene, const std::vector<PlacedMesh>& all, std::uint32_t id, const Coordinates& at) {
        const PlacedMesh& placed = all[id];
        std::size_t covered = 0, twice = 0, met = 0;
        for (std::size_t t = placed.first_triangle; t < placed.first_triangle + placed.triangles; ++t) {
            std::array<Vec2, 3> p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = float(kCells) * at.uv(t, k);
            p = counter_clockwise(p);
            const Vec2 e = p[1] - p[0], f = p[2] - p[0];
            for_cells_inside(p, 1e-3 * double(e.x * f.y - e.y * f.x), [&](long x, long y) {
                std::uint32_t& owner = owner_[std::size_t(y) * kCells + std::size_t(x)];
                ++covered, twice += owner == id, met += owner != id && owner != kNobody;
                owner = id;
                return true;
            });
        }
        const std::size_t tolerated = std::max(kTolerated, covered / kToleratedShare);
        if (twice > tolerated)
            throw Error(
                name_of(scene, placed),
                "has a TEXCOORD_1 that covers the same place twice; lay it out without overlaps or bake without "
                "--keep-uv2");
        return met > tolerated;
    }

  private:
    static constexpr std::uint32_t kNobody = ~0u;
    std::vector<std::uint32_t> owner_ = std::vector<std::uint32_t>(std::size_t(kCells) * kCells, kNobody);
};

/// Numbers of sets that grow together.
class Sets {
  public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

struct Corner {
    Vec3 place;
    Vec2 uv;
    bool operator==(const Corner&) const = default;
};
struct CornerHash {
    std::size_t operator()(const Corner& c) const {
        std::uint64_t h = 0;
        for (const float x : {c.place.x, c.place.y, c.place.z, c.uv.x, c.uv.y})
            h = mix64(h ^ std::bit_cast<std::uint32_t>(x + 0.0f));
        return h;
    }
};

/// Appends the islands of one copy of a mesh.
void add_islands(const PlacedMesh& placed, const Coordinates& at, const std::vector<Facet>& facet, const Vec2& scale,
                 std::vector<Chart>& islands) {
    Sets sets(placed.triangles);
    std::unordered_map<Corner, std::uint32_t, CornerHash> first;
    for (std::uint32_t i = 0; i < placed.triangles; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t t = placed.first_triangle + i;
            sets.join(first.try_emplace({Vec3(at.place(t, k)), at.uv(t, k)}, i).first->second, i);
        }
    std::vector<std::uint32_t> island(placed.triangles, ~0u);
    const std::size_t begin = islands.size();
    for (std::uint32_t i = 0; i < placed.triangles; ++i) {
        const std::size_t t = placed.first_triangle + i;
        if (!(facet[t].area > 0.0f)) continue;
        std::uint32_t& id = island[sets.find(i)];
        if (id == ~0u) id = std::uint32_t(islands.size()), islands.emplace_back();
        islands[id].triangles.push_back(std::uint32_t(t));
    }
    for (std::size_t id = begin; id < islands.size(); ++id) {
        Vec2 low(INFINITY), high(-INFINITY);
        for (const std::uint32_t t : islands[id].triangles)
            for (std::size_t k = 0; k < 3; ++k) low = glm::min(low, at.uv(t, k)), high = glm::max(high, at.uv(t, k));
        islands[id].size = (high - low) * scale;
    }
}

/// low, high   of the rectangle
KeptLayout layout_of(std::span<const PlacedMesh> meshes, const Coordinates& at, const std::vector<Facet>& facet,
                     const Vec2& low, const Vec2& high) {
    Stretch all;
    for (const PlacedMesh& placed : meshes)
        for (std::size_t t = placed.first_triangle; t < placed.first_triangle + placed.triangles; ++t) all.add(at, t);
    KeptLayout layout;
    layout.low = low, layout.size = high - low;
    layout.metres = layout.size * all.scale();
    for (const PlacedMesh& placed : meshes) add_islands(placed, at, facet, all.scale(), layout.islands);
    return layout;
}

KeptLayout own_layout(const PlacedMesh& placed, const Coordinates& at, const std::vector<Facet>& facet) {
    Vec2 low(INFINITY), high(-INFINITY);
    for (std::size_t t = placed.first_triangle; t < placed.first_triangle + placed.triangles; ++t)
        for (std::size_t k = 0; k < 3; ++k) low = glm::min(low, at.uv(t, k)), high = glm::max(high, at.uv(t, k));
    return layout_of({&placed, 1}, at, facet, low, high);
}

}  // namespace

KeptLayouts kept_layouts(const Scene& scene, const WorldMesh& mesh) {
    const Coordinates at(mesh);
    const std::vector<Facet> facet = facets(mesh);
    std::vector<PlacedMesh> meshes;
    std::vector<std::string> unwrapped;
    for (const PlacedMesh& placed : placed_meshes(scene, Part::Static)) {
        if (placed.triangles == 0) continue;
        if (has_layout(scene, placed, at))
            meshes.push_back(placed);
        else
            unwrapped.push_back(name_of(scene, placed));
    }
    if (meshes.empty())
        throw Error("--keep-uv2", "no static mesh of the scene has a TEXCOORD_1 with area; bake without it");

    KeptLayouts result;
    result.kept.assign(mesh.triangle_count(), false);
    bool shared = false;
    Cover cover;
    for (std::uint32_t id = 0; id < meshes.size(); ++id) {
        shared |= cover.add(scene, meshes, id, at);
        const auto first = result.kept.begin() + std::ptrdiff_t(meshes[id].first_triangle);
        std::fill(first, first + std::ptrdiff_t(meshes[id].triangles), true);
    }
    if (shared)
        for (const PlacedMesh& placed : meshes) result.layouts.push_back(own_layout(placed, at, facet));
    else
        result.layouts.push_back(layout_of(meshes, at, facet, Vec2(0.0f), Vec2(1.0f)));
    if (!shared) result.layouts.front().texels = scene.extras.lightmap;

    result.note = "TEXCOORD_1 of " + std::to_string(meshes.size()) + " meshes kept " +
                  (shared ? "in a rectangle each" : "as one layout");
    if (!unwrapped.empty())
        result.note += "; " + std::to_string(unwrapped.size()) + " without it unwrapped (" + unwrapped.front() +
                       (unwrapped.size() > 1 ? " and others)" : ")");
    return result;
}

}  // namespace daylit
