#include "gi/transport/path_trace/panes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "engine/base/random.h"

namespace daylit {
namespace {

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        std::uint64_t h = 0;
        // + 0.0f: minus zero equals zero, so it must hash alike
        for (int axis = 0; axis < 3; ++axis) h = mix64(h ^ std::bit_cast<std::uint32_t>(p[axis] + 0.0f));
        return h;
    }
};

/// Sets of connected vertices (union-find with path halving).
class Components {
  public:
    std::uint32_t add() {
        parents_.push_back(std::uint32_t(parents_.size()));
        return parents_.back();
    }
    std::uint32_t root(std::uint32_t i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) { parents_[root(a)] = root(b); }
    std::size_t size() const { return parents_.size(); }

  private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace

std::vector<bool> find_panes(const WorldMesh& mesh, const Materials& materials) {
    std::vector<std::uint32_t> glass;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
        if (materials.glass(mesh.materials[t])) glass.push_back(t);
    if (glass.empty()) return {};

    std::unordered_map<Vec3, std::uint32_t, PositionHash> vertices;
    Components components;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;  // from low to high minus from high to low
    std::vector<std::uint32_t> first_vertices;
    for (const std::uint32_t t : glass) {
        std::array<std::uint32_t, 3> v;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [place, added] = vertices.try_emplace(mesh.positions[mesh.indices[3 * std::size_t(t) + k]], 0);
            if (added) place->second = components.add();
            v[k] = place->second;
        }
        first_vertices.push_back(v[0]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = v[k], b = v[(k + 1) % 3];
            components.join(a, b);
            if (a != b) edges[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    std::vector<bool> open(components.size(), false);
    for (const auto& [edge, balance] : edges)
        if (balance != 0) open[components.root(edge.first)] = true;

    std::vector<bool> panes(mesh.triangle_count(), false);
    for (std::size_t i = 0; i < glass.size(); ++i) panes[glass[i]] = open[components.root(first_vertices[i])];
    return panes;
}

}  // namespace daylit
