#include "gi/encode/volume_octree.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <tuple>

namespace daylit {
namespace {

Lattice corner_of(const Octree::Node& node, int corner) {
    return node.at + node.units() * Lattice(corner & 1, corner >> 1 & 1, corner >> 2);
}

/// Which corner of the node a lattice place is; -1: none.
int corner_at(const Octree::Node& node, const Lattice& at) {
    const Lattice d = at - node.at;
    int corner = 0;
    for (int a = 0; a < 3; ++a) {
        if (d[a] != 0 && d[a] != node.units()) return -1;
        if (d[a] != 0) corner |= 1 << a;
    }
    return corner;
}

bool overlap_along(int axis, const Octree::Node& a, const Octree::Node& b) {
    return a.at[axis] < b.at[axis] + b.units() && b.at[axis] < a.at[axis] + a.units();
}

class CellMaker {
  public:
    CellMaker(const Octree& octree, const SameLight& same_light) : octree_(octree), same_light_(same_light) {}

    OctreeCells make() {
        list_cells();
        for (std::uint32_t c = 0; c < out_.cells.size(); ++c)
            for (int corner = 0; corner < 8; ++corner) settle(corner_of(node(c), corner));
        sampled_ = std::uint32_t(out_.samples.size());
        out_.tree.samples = sampled_;
        // Large cells first, so that what a corner hangs on is known already.
        for (std::uint32_t c = 0; c < out_.cells.size(); ++c)
            for (int corner = 0; corner < 8; ++corner) set_record(c, corner, record(c, corner));
        write_nodes();
        return std::move(out_);
    }

  private:
    struct Group {
        std::vector<std::uint32_t> cells;  // large ones first
        std::uint32_t sample = ~0u;        // ~0u: hangs
    };
    using Key = std::tuple<int, int, int>;
    static Key key(const Lattice& at) { return {at.x, at.y, at.z}; }

    const Octree::Node& node(std::uint32_t cell) const { return octree_.nodes[out_.cells[cell].leaf]; }

    void list_cells() {
        for (std::uint32_t n = 0; n < octree_.nodes.size(); ++n) {
            const Octree::Node& leaf = octree_.nodes[n];
            if (!leaf.leaf() || leaf.empty) continue;
            for (int side = 0; side < (leaf.cut ? 2 : 1); ++side)
                if (!leaf.cut || !leaf.side_empty[std::size_t(side)]) out_.cells.push_back({n, side});
        }
        std::stable_sort(out_.cells.begin(), out_.cells.end(), [&](const LeafSide& a, const LeafSide& b) {
            return octree_.nodes[a.leaf].level < octree_.nodes[b.leaf].level;
        });
        cells_of_.assign(octree_.nodes.size(), {~0u, ~0u});
        for (std::uint32_t c = 0; c < out_.cells.size(); ++c) {
            cells_of_[out_.cells[c].leaf][std::size_t(out_.cells[c].side)] = c;
            const Octree::Node& leaf = node(c);
            out_.tree.cells.push_back({Vec4(octree_.place(leaf.at), octree_.side_of(leaf)), {}, {}});
        }
    }

    std::vector<std::uint32_t> touching(const Lattice& at) const {
        std::vector<std::uint32_t> cells;
        for (int octant = 0; octant < 8; ++octant) {
            const std::uint32_t leaf = octree_.leaf(at, octant);
            if (leaf == ~0u) continue;
            for (const std::uint32_t c : cells_of_[leaf])
                if (c != ~0u && std::find(cells.begin(), cells.end(), c) == cells.end()) cells.push_back(c);
        }
        std::sort(cells.begin(), cells.end());
        return cells;
    }

    /// Groups the cells around a corner, and gives each group whose largest cell has this corner a sample.
    void settle(const Lattice& at) {
        std::vector<Group>& groups = groups_[key(at)];
        if (!groups.empty()) return;
        const std::vector<std::uint32_t> cells = touching(at);
        std::vector<std::size_t> group(cells.size());
        std::iota(group.begin(), group.end(), std::size_t(0));
        for (std::size_t i = 0; i < cells.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (group[i] != group[j] && same_light_(at, out_.cells[cells[i]], out_.cells[cells[j]])) {
                    const std::size_t from = std::max(group[i], group[j]), to = std::min(group[i], group[j]);
                    std::replace(group.begin(), group.end(), from, to);
                }
        for (std::size_t g = 0; g < cells.size(); ++g) {
            Group made;
            for (std::size_t i = 0; i < cells.size(); ++i)
                if (group[i] == g) made.cells.push_back(cells[i]);
            if (made.cells.empty()) continue;
            if (corner_at(node(made.cells[0]), at) >= 0) {
                made.sample = std::uint32_t(out_.samples.size());
                SampledCorner& sample = out_.samples.emplace_back(SampledCorner{at, {}});
                for (const std::uint32_t c : made.cells) sample.seen_by.push_back(out_.cells[c]);
            }
            groups.push_back(std::move(made));
        }
    }

    std::uint32_t record(std::uint32_t cell, int corner) {
        const Lattice at = corner_of(node(cell), corner);
        for (const Group& group : groups_[key(at)]) {
            if (std::find(group.cells.begin(), group.cells.end(), cell) == group.cells.end()) continue;
            return group.sample != ~0u ? group.sample : hang(at, cell, group);
        }
        assert(false && "every corner of every cell is settled");
        return 0;
    }

    std::uint32_t hang(const Lattice& at, std::uint32_t cell, const Group& group) {
        HangingCorner corner;
        const std::uint32_t largest = group.cells[0];
        corner.cell.fill(largest);
        for (int axis = 0; axis < 3; ++axis)
            for (const std::uint32_t other : group.cells) {
                if (node(other).level >= node(cell).level) break;
                if (!overlap_along(axis, node(other), node(cell))) continue;
                corner.cell[std::size_t(axis) + 1] = other;
                break;
            }
        for (std::size_t part = 0; part < 4; ++part) {
            const Octree::Node& source = node(corner.cell[part]);
            corner.t[part] = Vec3(at - source.at) / float(source.units());
        }
        const auto known = hanging_.find({key(at), corner.cell});
        if (known != hanging_.end()) return known->second;
        const std::uint32_t made = sampled_ + std::uint32_t(out_.tree.hanging.size());
        out_.tree.hanging.push_back(corner);
        hanging_[{key(at), corner.cell}] = made;
        return made;
    }

    void set_record(std::uint32_t cell, int corner, std::uint32_t record) {
        glsl::VolumeCell& c = out_.tree.cells[cell];
        (corner < 4 ? c.low[corner] : c.high[corner - 4]) = record;
    }

    /// Nodes as the runtime walks them; leaves without cells lead to the nearest cell.
    void write_nodes() {
        VolumeTree& tree = out_.tree;
        tree.origin = octree_.origin, tree.side = octree_.side, tree.size = octree_.size;
        tree.nodes.resize(octree_.nodes.size());
        for (std::uint32_t n = 0; n < octree_.nodes.size(); ++n) {
            const Octree::Node& from = octree_.nodes[n];
            tree.nodes[n] = !from.leaf() ? glsl::kVolumeInner | from.children
                            : from.empty ? nearest(octree_.centre(from))
                            : !from.cut  ? glsl::kVolumeCell | cells_of_[n][0]
                                         : glsl::kVolumeCut | std::uint32_t(tree.cuts.size());
            if (from.leaf() && !from.empty && from.cut) tree.cuts.push_back(cut(n));
        }
    }

    glsl::VolumeCut cut(std::uint32_t n) const {
        const Octree::Node& from = octree_.nodes[n];
        const auto side = [&](std::size_t i) {
            return cells_of_[n][i] != ~0u ? glsl::kVolumeCell | cells_of_[n][i] : nearest(octree_.centre(from));
        };
        return {from.plane, {side(0), side(1), 0, 0}};
    }

    std::uint32_t nearest(const Vec3& place) const {
        std::uint32_t best = 0;
        float least = 1e30f;
        for (std::uint32_t c = 0; c < out_.tree.cells.size(); ++c) {
            const Vec4& box = out_.tree.cells[c].box;
            const Vec3 in = glm::clamp(place, Vec3(box), Vec3(box) + box.w);
            const float distance = glm::distance(in, place);
            if (distance < least) least = distance, best = c;
        }
        return glsl::kVolumeNearest | best;
    }

    const Octree& octree_;
    const SameLight& same_light_;
    OctreeCells out_;
    std::uint32_t sampled_ = 0;
    std::vector<std::array<std::uint32_t, 2>> cells_of_;  // by leaf and side
    std::map<Key, std::vector<Group>> groups_;
    std::map<std::pair<Key, std::array<std::uint32_t, 4>>, std::uint32_t> hanging_;
};

}  // namespace

Octree::Octree(const Vec3& from, float root_side, const std::array<int, 3>& roots)
    : origin(from), side(root_side), size(roots) {
    for (int z = 0; z < roots[2]; ++z)
        for (int y = 0; y < roots[1]; ++y)
            for (int x = 0; x < roots[0]; ++x) nodes.push_back({.at = kOctreeUnits * Lattice(x, y, z)});
}

void Octree::split(std::uint32_t n) {
    const Node parent = nodes[n];
    assert(parent.leaf() && parent.level < glsl::kVolumeMostLevels);
    nodes[n].children = std::uint32_t(nodes.size());
    for (int corner = 0; corner < 8; ++corner)
        nodes.push_back({.at = parent.at + parent.units() / 2 * Lattice(corner & 1, corner >> 1 & 1, corner >> 2),
                         .level = parent.level + 1});
}

std::uint32_t Octree::leaf(const Lattice& at, int octant) const {
    // Half a unit into the octant: twice the coordinates, plus or minus one, keeps it whole.
    glm::i64vec3 inside = std::int64_t(2) * glm::i64vec3(at);
    for (int a = 0; a < 3; ++a) {
        inside[a] += octant >> a & 1 ? 1 : -1;
        if (inside[a] < 0 || inside[a] >= 2 * std::int64_t(kOctreeUnits) * size[std::size_t(a)]) return ~0u;
    }
    const glm::i64vec3 root = inside / (2 * std::int64_t(kOctreeUnits));
    auto n = std::uint32_t((root.z * size[1] + root.y) * size[0] + root.x);
    while (!nodes[n].leaf()) {
        const Node& child = nodes[nodes[n].children];
        int which = 0;
        for (int a = 0; a < 3; ++a)
            if (inside[a] >= 2 * (std::int64_t(child.at[a]) + child.units())) which |= 1 << a;
        n = nodes[n].children + std::uint32_t(which);
    }
    return n;
}

OctreeCells make_cells(const Octree& octree, const SameLight& same_light) {
    return CellMaker(octree, same_light).make();
}

}  // namespace daylit
