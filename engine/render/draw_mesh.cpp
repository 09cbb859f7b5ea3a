#include "engine/render/draw_mesh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numeric>

namespace daylit {
namespace {

constexpr std::size_t kClusterTriangles = 128;
constexpr std::uint32_t kNone = ~std::uint32_t(0);

void pack_frame(VertexAttributes& a, const Vec3& normal, const Vec4& tangent) {
    for (int i = 0; i < 3; ++i) a.normal[i] = std::int16_t(std::lround(glm::clamp(normal[i], -1.0f, 1.0f) * 32767.0f));
    a.tangent = glm::packSnorm3x10_1x2(tangent);
}

VertexAttributes pack(const WorldMesh& mesh, std::uint32_t v) {
    VertexAttributes a{};
    pack_frame(a, mesh.normals[v], mesh.tangents[v]);
    for (int set = 0; set < 2; ++set)
        for (int i = 0; i < 2; ++i) a.uvs[2 * set + i] = mesh.uvs[v][std::size_t(set)][i];
    for (int i = 0; i < 4; ++i) a.color[i] = glm::packHalf1x16(mesh.colors[v][i]);
    return a;
}

/// Splits triangles at the median of the longest axis of their centres until a cluster is small.
class Clusterer {
  public:
    Clusterer(const WorldMesh& mesh, std::vector<std::uint32_t>& order) : order_(order) {
        centers_.resize(mesh.triangle_count());
        for (std::size_t t = 0; t < centers_.size(); ++t)
            centers_[t] = (mesh.positions[mesh.indices[3 * t]] + mesh.positions[mesh.indices[3 * t + 1]] +
                           mesh.positions[mesh.indices[3 * t + 2]]) / 3.0f;
    }
    void split(std::size_t begin, std::size_t end, std::vector<std::pair<std::size_t, std::size_t>>& ranges) {
        if (end - begin <= kClusterTriangles) {
            ranges.emplace_back(begin, end);
            return;
        }
        Bounds box;
        for (std::size_t i = begin; i < end; ++i) box.add(centers_[order_[i]]);
        const Vec3 size = box.max - box.min;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = (begin + end) / 2;
        std::nth_element(order_.begin() + long(begin), order_.begin() + long(middle), order_.begin() + long(end),
                         [&](std::uint32_t a, std::uint32_t b) {
                             const float x = centers_[a][axis], y = centers_[b][axis];
                             return x != y ? x < y : a < b;  // ties by number, so that the order is one
                         });
        split(begin, middle, ranges);
        split(middle, end, ranges);
    }

  private:
    std::vector<Vec3> centers_;
    std::vector<std::uint32_t>& order_;
};

/// Gives each triple of source vertex, lightmap place and cluster one vertex, in order of first use.
class VertexWelder {
  public:
    VertexWelder(const WorldMesh& mesh, DrawMesh& out) : mesh_(mesh), out_(out), first_(mesh.positions.size(), kNone) {}
    std::uint32_t vertex(std::uint32_t source, const Vec2& uv, std::uint16_t cluster) {
        const std::uint16_t place[2] = {coded(uv.x), coded(uv.y)};
        for (std::uint32_t v = first_[source]; v != kNone; v = next_[v])
            if (out_.attributes[v].cluster == cluster && std::equal(place, place + 2, out_.attributes[v].lightmap_uv)) return v;
        const auto v = std::uint32_t(out_.positions.size());
        out_.positions.push_back(mesh_.positions[source]);
        out_.attributes.push_back(pack(mesh_, source));
        std::copy(place, place + 2, out_.attributes.back().lightmap_uv);
        out_.attributes.back().cluster = cluster;
        out_.source.push_back(source);
        next_.push_back(first_[source]);
        first_[source] = v;
        return v;
    }

  private:
    static std::uint16_t coded(float x) { return std::uint16_t(std::lround(glm::clamp(x, 0.0f, 1.0f) * 65535.0f)); }

    const WorldMesh& mesh_;
    DrawMesh& out_;
    std::vector<std::uint32_t> first_, next_;
};

void set_bounds(DrawMesh& mesh, Cluster& cluster) {
    cluster.bounds = {};
    for (std::uint32_t i = 0; i < cluster.count; ++i)
        cluster.bounds.add(mesh.positions[mesh.indices[cluster.first + i]]);
}

}  // namespace

DrawMesh build_draw_mesh(const WorldMesh& mesh, const DayLightmap* lightmap, bool by_node) {
    assert(!lightmap || lightmap->corner_uvs.size() == mesh.indices.size());
    std::vector<std::uint32_t> order(mesh.triangle_count());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t t) {
        return std::uint64_t(mesh.materials[t]) << 32 | (by_node ? mesh.nodes[t] : 0u);
    };
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });

    DrawMesh out;
    out.indices.reserve(mesh.indices.size());
    Clusterer clusterer(mesh, order);
    VertexWelder welder(mesh, out);
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        while (end < order.size() && key(order[end]) == key(order[begin])) ++end;
        const std::uint32_t material = mesh.materials[order[begin]];
        if (out.batches.empty() || out.batches.back().material != material)
            out.batches.push_back({material, std::uint32_t(out.clusters.size()), 0, false});
        std::vector<std::pair<std::size_t, std::size_t>> ranges;
        clusterer.split(begin, end, ranges);
        for (const auto& [from, to] : ranges) {
            std::sort(order.begin() + long(from), order.begin() + long(to));
            Cluster cluster{{}, std::uint32_t(out.indices.size()), std::uint32_t(3 * (to - from)),
                            mesh.nodes[order[from]]};
            for (std::size_t i = from; i < to; ++i)
                for (std::size_t corner = 3 * std::size_t(order[i]); corner < 3 * std::size_t(order[i]) + 3; ++corner) {
                    const std::uint32_t v = mesh.indices[corner];
                    out.indices.push_back(welder.vertex(v, lightmap ? lightmap->corner_uvs[corner] : Vec2(0.0f),
                                                        std::uint16_t(out.clusters.size())));
                    if (mesh.colors[v] != Rgba(1.0f)) out.batches.back().vertex_colors = true;
                }
            set_bounds(out, cluster);
            out.clusters.push_back(cluster);
            ++out.batches.back().cluster_count;
        }
    }
    return out;
}

std::vector<Bounds> move_draw_mesh(DrawMesh& mesh, const WorldMesh& moved) {
    std::vector<bool> changed(mesh.positions.size()), turned(mesh.positions.size());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const std::uint32_t source = mesh.source[v];
        const std::array<std::int16_t, 3> normal = std::to_array(mesh.attributes[v].normal);
        changed[v] = mesh.positions[v] != moved.positions[source];
        mesh.positions[v] = moved.positions[source];
        pack_frame(mesh.attributes[v], moved.normals[source], moved.tangents[source]);
        turned[v] = normal != std::to_array(mesh.attributes[v].normal);
    }
    std::vector<Bounds> boxes;
    for (Cluster& cluster : mesh.clusters) {
        const auto begin = mesh.indices.begin() + long(cluster.first);
        const auto any = [&](const std::vector<bool>& of) {
            return std::any_of(begin, begin + long(cluster.count), [&](std::uint32_t v) { return of[v]; });
        };
        const bool elsewhere = any(changed);
        if (elsewhere || any(turned)) ++cluster.moves;
        if (!elsewhere) continue;
        boxes.push_back(cluster.bounds);
        set_bounds(mesh, cluster);
        boxes.push_back(cluster.bounds);
    }
    return boxes;
}

}  // namespace daylit
