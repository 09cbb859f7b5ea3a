#pragma once
// Which triangles a sun surely does not reach, from its shadow maps, so that they are drawn without asking for it.
#include <span>

#include "engine/render/farthest_depth.h"
#include "engine/render/sun_shadow.h"

namespace daylit {

/// False only when shaders/sun_visibility.glsl would find every point of the triangle in full shadow.
/// maps           by cascade
/// texels         along a map's side
/// double_sided   its back is seen as well
bool may_reach(const SunFit& fit, std::span<const FarthestDepth> maps, int texels, const TriangleCorners& triangle,
               bool double_sided);

}  // namespace daylit
