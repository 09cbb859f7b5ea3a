#include "engine/baked/volume_tree.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

/// One number of a hanging record: the source cell's interpolant (part 0), or its change along an axis.
float interpolated(const VolumeTree& tree, const HangingCorner& at, std::size_t part, std::span<const Vec4> records,
                   std::size_t numbers, std::size_t number) {
    const glsl::VolumeCell& cell = tree.cells[at.cell[part]];
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec4 weights = part == 0 ? glsl::volume_corner_weights(corner, at.t[part], cell.box.w)
                                       : corner_weights_change(corner, at.t[part], cell.box.w, int(part) - 1);
        sum += glm::dot(weights, records[numbers * record_of(cell, corner) + number]);
    }
    return sum;
}

/// Kind and number of a node are possible, and every child comes after its parent, so that each descent ends.
bool leads_somewhere(const VolumeTree& tree, std::size_t i) {
    const std::uint32_t node = tree.nodes[i], number = node & ~glsl::kVolumeKind;
    switch (node & glsl::kVolumeKind) {
        case glsl::kVolumeInner:
            return number > i && std::size_t(number) + 8 <= tree.nodes.size();
        case glsl::kVolumeCut:
            return number < tree.cuts.size();
        default:
            return number < tree.cells.size();
    }
}

bool sound(const glsl::VolumeCell& cell, std::size_t records) {
    for (int corner = 0; corner < 8; ++corner)
        if (record_of(cell, corner) >= records) return false;
    const Vec4& box = cell.box;
    return std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.z) && std::isfinite(box.w) && box.w > 0.0f;
}

}  // namespace

glsl::VolumeGrid VolumeTree::grid() const {
    return {Vec4(origin, 1.0f / side), Vec4(size[0], size[1], size[2], 0.0f)};
}

Bounds VolumeTree::bounds() const {
    Bounds box;
    if (empty()) return box;
    box.add(origin);
    box.add(origin + side * Vec3(size[0], size[1], size[2]));
    return box;
}

const glsl::VolumeCell& VolumeTree::cell_at(const Vec3& place) const {
    const glsl::VolumeArrays arrays{grid(), nodes.data(), cells.data(), cuts.data(), nullptr};
    return cells[glsl::volume_place(arrays, place).cell];
}

std::vector<float> record_sides(const VolumeTree& tree) {
    std::vector<float> sides(tree.samples, 0.0f);
    for (const glsl::VolumeCell& cell : tree.cells)
        for (int corner = 0; corner < 8; ++corner)
            if (record_of(cell, corner) < tree.samples)
                sides[record_of(cell, corner)] = std::max(sides[record_of(cell, corner)], cell.box.w);
    for (float& side : sides)
        if (side == 0.0f) side = 1.0f;
    return sides;
}

void fill_hanging(const VolumeTree& tree, std::span<Vec4> records, std::size_t numbers) {
    for (std::size_t h = 0; h < tree.hanging.size(); ++h)
        for (std::size_t number = 0; number < numbers; ++number)
            for (std::size_t part = 0; part < 4; ++part)
                records[numbers * (tree.samples + h) + number][glm::length_t(part)] =
                    interpolated(tree, tree.hanging[h], part, records, numbers, number);
}

Vec4 corner_weights_change(int corner, const Vec3& t, float side, int axis) {
    Vec3 u, sign;
    for (int a = 0; a < 3; ++a) {
        const bool upper = corner >> a & 1;
        u[a] = upper ? 1.0f - t[a] : t[a];
        sign[a] = upper ? -1.0f : 1.0f;
    }
    const Vec3 rest = Vec3(1.0f) - u;
    const float others = rest[(axis + 1) % 3] * rest[(axis + 2) % 3];  // w without this axis' factor
    const float bend = 1.0f + u.x * (1.0f - 2.0f * u.x) + u.y * (1.0f - 2.0f * u.y) + u.z * (1.0f - 2.0f * u.z);
    Vec4 change;
    change[0] = sign[axis] / side * others * (rest[axis] * (1.0f - 4.0f * u[axis]) - bend);
    for (int a = 0; a < 3; ++a)
        change[1 + a] =
            a == axis ? others * rest[a] * (1.0f - 3.0f * u[a]) : -sign[a] * sign[axis] * u[a] * rest[a] * others;
    return change;
}

const char* fault(const VolumeTree& tree) {
    const std::size_t roots = std::size_t(tree.size[0]) * std::size_t(tree.size[1]) * std::size_t(tree.size[2]);
    if (tree.cells.empty() || roots == 0 || tree.nodes.size() < roots) return "has no cells";
    if (!(tree.side > 0.0f && std::isfinite(tree.side))) return "has cells without a size";
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
        if (!leads_somewhere(tree, i)) return "has a node that leads nowhere";
    for (const glsl::VolumeCut& cut : tree.cuts)
        for (const std::uint32_t node : {cut.nodes.x, cut.nodes.y}) {
            const std::uint32_t kind = node & glsl::kVolumeKind;
            if ((kind != glsl::kVolumeCell && kind != glsl::kVolumeNearest) ||
                (node & ~glsl::kVolumeKind) >= tree.cells.size())
                return "has a wall without sides";
        }
    for (const glsl::VolumeCell& cell : tree.cells)
        if (!sound(cell, tree.records())) return "has a cell without corners";
    for (std::size_t h = 0; h < tree.hanging.size(); ++h)
        for (const std::uint32_t cell : tree.hanging[h].cell) {
            if (cell >= tree.cells.size()) return "has a corner that hangs on nothing";
            for (int corner = 0; corner < 8; ++corner)
                if (record_of(tree.cells[cell], corner) >= tree.samples + h)
                    return "has corners that hang on each other";
        }
    return nullptr;
}

}  // namespace daylit
