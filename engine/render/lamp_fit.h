#pragma once
// Where the shadow maps of a punctual lamp look: six around a point lamp or a wide spot, one along a narrow spot.
#include <vector>

#include "engine/scene/pose.h"
#include "shaders/shared/frame_block.h"

namespace daylit {

/// One map: looking along z from the lamp, tan_half to each side.
struct LampMap {
    Vec3 x, z;  // unit; y is cross(z, x)
};

/// The maps of a lamp, in the order of their layers, and the lamp's block with everything but its first layer.
struct LampFit {
    glsl::LampBlock block;
    float tan_half;  // of the angle that each map spans
    bool moves = false;
    std::vector<LampMap> maps;
};
/// texels   along a map's side
LampFit fit_lamp(const PlacedLight& lamp, int texels);

/// All alike but how bright they shine.
bool same_maps(const LampFit& a, const LampFit& b);

/// clip_from_world with reversed infinite depth: near / distance along z.
Mat4 lamp_matrix(const LampFit& fit, const LampMap& map);

}  // namespace daylit
