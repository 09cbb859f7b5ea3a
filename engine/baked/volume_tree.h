#pragma once
// The octree of an irradiance volume: which cell a place lies in, and which records the cell's corners take.
//
// Corner data belong to cells, not to places: two cells that a wall parts have different records at the same corner,
// and a small cell beside a large one takes there what the large one interpolates, so that values are continuous over
// every face, with neighbours of any sizes.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/units.h"
#include "engine/scene/pose.h"
#include "shaders/shared/volume.h"

namespace daylit {

/// A record that follows from others: at a corner which larger cells touch with a face or an edge.
struct HangingCorner {
    std::array<std::uint32_t, 4> cell{};  // whose interpolant gives the value, and the change along x, y, z
    std::array<Vec3, 4> t{};              // where in that cell
};

inline std::uint32_t record_of(const glsl::VolumeCell& cell, int corner) {
    return corner < 4 ? cell.low[corner] : cell.high[corner - 4];
}

struct VolumeTree {
    Vec3 origin = Vec3(0.0f);
    float side = 1.0f;                    // of a root, metres
    std::array<int, 3> size = {0, 0, 0};  // roots along x, y, z
    std::vector<std::uint32_t> nodes;     // roots, x fastest, then blocks of eight children
    std::vector<glsl::VolumeCell> cells;  // large ones first
    std::vector<glsl::VolumeCut> cuts;
    std::uint32_t samples = 0;  // records with data of their own; the hanging ones follow in order
    std::vector<HangingCorner> hanging;

    bool empty() const { return cells.empty(); }
    std::size_t records() const { return samples + hanging.size(); }
    glsl::VolumeGrid grid() const;
    Bounds bounds() const;
    /// Where glsl::volume_place() leads; not for an empty tree.
    const glsl::VolumeCell& cell_at(const Vec3& place) const;
};

/// Metres: the side of the largest cell that has each sampled record; what its change is stored over.
std::vector<float> record_sides(const VolumeTree& tree);

/// Fills records samples, samples + 1, ... of `numbers` vec4 each (value and change along x, y, z) from those before.
void fill_hanging(const VolumeTree& tree, std::span<Vec4> records, std::size_t numbers = glsl::kVolumeNumbers);

/// d/dx, d/dy or d/dz (axis 0 to 2), per metre, of glsl::volume_corner_weights().
Vec4 corner_weights_change(int corner, const Vec3& t, float side, int axis);

/// What is wrong with a tree that was read from a file: an index out of range, a node that leads into a circle, a cell
/// without a size; null when nothing is. A tree that passes makes no look-up leave its arrays.
const char* fault(const VolumeTree& tree);

}  // namespace daylit
