#pragma once
// Numbers for the gather beyond the shared sampling families.
#include <cmath>
#include <cstdint>

#include "gi/transport/path_trace/sampling.h"

namespace daylit {

/// Uniform over the sun's disc, small enough to be flat, in a frame whose z looks at its middle; u in [0,1)^2.
inline Vec3 sample_sun_disc(const Vec2& u) {
    const float r = std::tan(float(kSunRadius)) * std::sqrt(u.x), phi = 2.0f * kPiF * u.y;
    return glm::normalize(Vec3(r * std::cos(phi), r * std::sin(phi), 1.0f));
}

/// x modulo 1, in [0,1).
inline float fraction(float x) {
    const float f = x - std::floor(x);
    return f < 1.0f ? f : 0.0f;
}

/// Van der Corput in base 2.
inline float radical_inverse(std::uint32_t i) {
    i = (i << 16) | (i >> 16);
    i = ((i & 0x00FF00FFu) << 8) | ((i & 0xFF00FF00u) >> 8);
    i = ((i & 0x0F0F0F0Fu) << 4) | ((i & 0xF0F0F0F0u) >> 4);
    i = ((i & 0x33333333u) << 2) | ((i & 0xCCCCCCCCu) >> 2);
    i = ((i & 0x55555555u) << 1) | ((i & 0xAAAAAAAAu) >> 1);
    return float(i >> 8) * 0x1p-24f;
}

}  // namespace daylit
