#include "engine/baked/volume_mode.h"

#include <algorithm>
#include <array>

#include "engine/base/error.h"

namespace daylit {
namespace {

constexpr std::array<const char*, 4> kModeNames = {"auto", "object", "vertex", "pixel"};
constexpr float kShareOfCell = 0.25f;  // over which light is as good as even

float local_cell(const Bounds& box, const VolumeTree& tree) {
    float side = tree.cell_at(0.5f * (box.min + box.max)).box.w;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 place = glm::mix(box.min, box.max, Vec3(corner & 1, corner >> 1 & 1, corner >> 2));
        side = std::min(side, tree.cell_at(place).box.w);
    }
    return side;
}

}  // namespace

VolumeMode parse_volume_mode(const std::string& name) {
    const auto found = std::find(kModeNames.begin(), kModeNames.end(), name);
    if (found == kModeNames.end())
        throw UsageError("--volume-mode", "'" + name + "' is not one of auto, object, vertex, pixel");
    return VolumeMode(found - kModeNames.begin());
}

const char* name(VolumeMode mode) {
    return kModeNames[std::size_t(mode)];
}

VolumeMode volume_mode_of(const ThingSize& thing, const VolumeTree& tree) {
    const float even = kShareOfCell * local_cell(thing.box, tree);
    const Vec3 size = thing.box.max - thing.box.min;
    if (std::max({size.x, size.y, size.z}) <= even) return VolumeMode::Object;
    return thing.edge <= even ? VolumeMode::Vertex : VolumeMode::Pixel;
}

}  // namespace daylit
