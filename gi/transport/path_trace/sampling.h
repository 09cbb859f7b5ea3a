#pragma once
// Directions and points drawn from densities, in families sample_x / pdf_x. Densities are per solid angle; local
// frames have z up. The methods are those of Pharr, Jakob, Humphreys 2023, appendix A.5, and Duff et al. 2017.
#include <algorithm>
#include <cmath>

#include "engine/base/units.h"

namespace daylit {

inline constexpr float kPiF = float(kPi);

/// Right-handed orthonormal frame about a unit normal (Duff et al. 2017, listing 3).
struct Frame {
    Vec3 x, y, z;
    explicit Frame(const Vec3& normal) : z(normal) {
        const float sign = std::copysign(1.0f, z.z);
        const float a = -1.0f / (sign + z.z);
        const float b = z.x * z.y * a;
        x = Vec3(1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x);
        y = Vec3(b, sign + z.y * z.y * a, -z.y);
    }
    Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

inline Vec3 direction_around_z(float cos_theta, float sin_theta, float u) {
    const float phi = 2.0f * kPiF * u;
    return Vec3(sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta);
}

inline Vec3 sample_cosine_hemisphere(float u, float v) {
    return direction_around_z(std::sqrt(1.0f - u), std::sqrt(u), v);
}
inline float pdf_cosine_hemisphere(float cos_theta) {
    return std::max(cos_theta, 0.0f) / kPiF;
}

/// Around z with density (n + 1) / (2 pi) cos^n (Lafortune and Willems 1994); z is the mirror direction.
inline Vec3 sample_phong_lobe(float exponent, float u, float v) {
    // 1 - u lies in (0,1]; sin^2 as -expm1(...), since for narrow lobes 1 - cos^2 would cancel.
    const float log_cos = std::log(1.0f - u) / (exponent + 1.0f);
    return direction_around_z(std::exp(log_cos), std::sqrt(-std::expm1(2.0f * log_cos)), v);
}

/// Uniform over a cap whose height is 1 - cos(radius): given as that difference, which a small cap's cosine loses.
inline Vec3 sample_cap(float height, float u, float v) {
    const float h = u * height;
    return direction_around_z(1.0f - h, std::sqrt(std::max(h * (2.0f - h), 0.0f)), v);
}
inline float pdf_cap(float height) {
    return 1.0f / (2.0f * kPiF * height);
}

/// Barycentric weights of the second and third corner, uniform over a triangle's area (Turk 1990).
inline Vec2 sample_triangle(float u, float v) {
    const float s = std::sqrt(u);
    return Vec2(s * (1.0f - v), s * v);
}

/// Veach 1997, eq. 9.14 with beta = 2: the weight of a sample drawn from `chosen` that `other` could have made too.
inline float power_heuristic(float chosen, float other) {
    if (std::isinf(chosen)) return 1.0f;
    const float ratio = other / chosen;
    return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace daylit
