#pragma once
// What stands between places, and whether a place is inside of something.
#include "gi/trace/ray_scene.h"

namespace daylit {

/// Whether any light passes straight between two places.
bool in_sight(const RayScene& rays, const Vec3& from, const Vec3& to);

/// Whether a place is inside of something solid: what is seen from it, all around, is mostly the backs of faces.
bool buried(const RayScene& rays, const Vec3& place);

}  // namespace daylit
