#pragma once
// Texels beside something thin, such as the floor's at the foot of a wall: one brightness for both of its sides would
// be light through the wall.
#include "gi/surface/texels.h"
#include "gi/trace/ray_scene.h"

namespace daylit {

/// Points of a cell are one texel when a chain of them sees one another from a little above the surface; those under
/// something that lies or hangs there are another, and so are those inside of something solid.
/// rays   of the mesh that the atlas is of
Texels make_parted_texels(const RayScene& rays, const Atlas& atlas);

/// As Texels::at(), but beside walls the texel of the nearest point that is in sight, which may be a neighbour's.
/// place   where on the triangle, in the world
/// back    seen from behind
std::uint32_t texel_in_sight(const RayScene& rays, const Atlas& atlas, const Texels& texels, std::uint32_t triangle,
                             const Vec2& barycentric, const Vec3& place, bool back);

}  // namespace daylit
