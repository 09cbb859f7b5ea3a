#pragma once
// Which triangles a sun surely does not reach, from its shadow maps, so that they are drawn without asking for it.
#include <array>
#include <span>
#include <vector>

#include "engine/render/draw_mesh.h"
#include "engine/render/sun_shadow.h"

namespace daylit {

/// The greatest depth over blocks of a shadow map: level 0 as given, each further one over 2 x 2 of the one before.
class FarthestDepth {
  public:
    FarthestDepth() = default;
    /// finest   side * side values from row 0; side is a power of two
    FarthestDepth(int side, std::vector<float> finest);
    int side() const { return side_; }
    /// Bound from above of the values in blocks [min, max] of level 0, clamped to the map.
    float over(const Vec2& min, const Vec2& max) const;

  private:
    int side_ = 0;
    std::vector<std::vector<float>> levels_;
};

/// Corners in the world, counter-clockwise seen from the front.
using TriangleCorners = std::array<Vec3, 3>;

/// False only when shaders/sun_visibility.glsl would find every point of the triangle in full shadow.
/// maps           by cascade
/// texels         along a map's side
/// double_sided   its back is seen as well
bool may_reach(const SunFit& fit, std::span<const FarthestDepth> maps, int texels, const TriangleCorners& triangle,
               bool double_sided);

}  // namespace daylit
