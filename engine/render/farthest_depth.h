#pragma once
// How far a light's rays go at most before something stops them, over any part of its shadow map.
#include <array>
#include <vector>

#include "engine/base/vec.h"

namespace daylit {

/// Corners in the world, counter-clockwise seen from the front.
using TriangleCorners = std::array<Vec3, 3>;

/// Greatest values over blocks: level 0 as given, each further one over 2 x 2 of the one before.
class FarthestDepth {
  public:
    FarthestDepth() = default;
    /// finest   width * height values, none below 0, from row 0
    FarthestDepth(int width, int height, std::vector<float> finest);
    /// Bound from above of the values in blocks [min, max] of level 0, clamped to the map.
    float over(const Vec2& min, const Vec2& max) const;

  private:
    struct Level {
        int width, height;
        std::vector<float> values;
    };
    std::vector<Level> levels_;
};

}  // namespace daylit
