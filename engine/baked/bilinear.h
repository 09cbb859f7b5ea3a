#pragma once
// How a texture unit mixes texels.
#include <algorithm>

#include "engine/base/units.h"

namespace daylit {

/// texel(x, y) mixed as a bilinear fetch does at uv in [0,1]^2, held at the borders.
template <class Texel>
Rgb bilinear(int width, int height, const Vec2& uv, const Texel& texel) {
    const float x = std::clamp(uv.x * float(width) - 0.5f, 0.0f, float(width - 1));
    const float y = std::clamp(uv.y * float(height) - 0.5f, 0.0f, float(height - 1));
    const int x0 = int(x), y0 = int(y);
    const int x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
    const float fx = x - float(x0), fy = y - float(y0);
    return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), fx), glm::mix(texel(x0, y1), texel(x1, y1), fx), fy);
}

}  // namespace daylit
