#pragma once
// What a camera or a shadow map cannot see is not drawn.
#include <array>

#include "engine/scene/pose.h"

namespace daylit {

/// The half-spaces inside of which a clip-space volume lies (Gribb and Hartmann 2001).
struct Frustum {
    std::array<Vec4, 6> planes;  // dot(plane.xyz, p) + plane.w >= 0 inside; not normalised
    int count = 6;
};

/// For depth in [0, 1]. infinite_reversed: a camera, whose far plane (z = 0) is at infinity and left out.
Frustum frustum(const Mat4& clip_from_world, bool infinite_reversed);

/// False only when the box is surely outside.
bool may_see(const Frustum& frustum, const Bounds& box);

}  // namespace daylit
