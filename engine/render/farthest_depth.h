#pragma once
// How far a light's rays go at most before something stops them, over any part of its shadow map.
#include <array>
#include <vector>

#include "engine/base/vec.h"

namespace daylit {

/// Corners in the world, counter-clockwise seen from the front.
using TriangleCorners = std::array<Vec3, 3>;

/// Cosine with a light at which a front surely turns away, whatever a pixel's derivatives say of its plane.
inline constexpr float kTurnedAway = -0.02f;

/// The greatest depth over blocks of a shadow map: level 0 as given, each further one over 2 x 2 of the one before.
class FarthestDepth {
  public:
    FarthestDepth() = default;
    /// finest   side * side values, none below 0, from row 0; side is a power of two
    FarthestDepth(int side, std::vector<float> finest);
    /// Bound from above of the values in blocks [min, max] of level 0, clamped to the map.
    float over(const Vec2& min, const Vec2& max) const;

  private:
    int side_ = 0;
    std::vector<std::vector<float>> levels_;
};

}  // namespace daylit
