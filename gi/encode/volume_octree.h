#pragma once
// From a refined octree to the cells, records and constraints that the runtime reads.
#include <functional>

#include "engine/baked/volume_tree.h"

namespace daylit {

/// A place of the finest lattice: root corners are kOctreeUnits apart, so that the finest cells too have middles.
using Lattice = glm::ivec3;
inline constexpr int kOctreeUnits = 2 << glsl::kVolumeMostLevels;

/// An octree while it is being refined.
struct Octree {
    struct Node {
        Lattice at;                        // first corner
        int level = 0;                     // 0: a root
        std::uint32_t children = 0;        // first of eight, x fastest; 0: a leaf
        bool empty = false;                // a leaf where nothing can be
        bool cut = false;                  // a leaf with a thin wall through it
        Vec4 plane = Vec4(0.0f);           // the wall: in front where dot(xyz, place) + w >= 0, metres
        std::array<bool, 2> side_empty{};  // of a cut leaf: nothing can be in front, behind

        int units() const { return kOctreeUnits >> level; }
        bool leaf() const { return children == 0; }
    };

    Octree() = default;
    Octree(const Vec3& origin, float side, const std::array<int, 3>& size);

    Vec3 origin = Vec3(0.0f);
    float side = 1.0f;  // of a root, metres
    std::array<int, 3> size = {0, 0, 0};
    std::vector<Node> nodes;  // roots first, x fastest

    void split(std::uint32_t node);
    /// The leaf that contains the lattice place's neighbourhood towards an octant (bit a set: upwards along axis a);
    /// ~0u outside.
    std::uint32_t leaf(const Lattice& at, int octant) const;
    Vec3 place(const Lattice& at) const { return origin + side / float(kOctreeUnits) * Vec3(at); }
    Vec3 centre(const Node& n) const { return place(n.at + n.units() / 2); }
    float side_of(const Node& n) const { return side / float(1 << n.level); }
};

/// A leaf, or the front (0) or back (1) of a cut one.
struct LeafSide {
    std::uint32_t leaf = 0;
    int side = 0;
    bool operator==(const LeafSide&) const = default;
};

/// A record with data of its own: where, and for which of the cells that touch there.
struct SampledCorner {
    Lattice at;
    std::vector<LeafSide> seen_by;  // large ones first
};

/// Whether light is the same for two cells at a corner that both touch, that is, no wall is between them there.
using SameLight = std::function<bool(const Lattice& corner, const LeafSide& a, const LeafSide& b)>;

struct OctreeCells {
    VolumeTree tree;
    std::vector<SampledCorner> samples;  // one per record of the tree's samples
    std::vector<LeafSide> cells;         // one per cell of the tree
};

/// Cells, large before small. At each corner the cells that touch there are grouped by `same_light`. If the group's
/// largest has its own corner there, the whole group shares one sampled record. Otherwise the corner hangs: the value
/// is what the largest interpolates, and so is each component of change along which a larger cell overlaps the small
/// one. With that, values agree all over every face between cells of one group.
OctreeCells make_cells(const Octree& octree, const SameLight& same_light);

}  // namespace daylit
