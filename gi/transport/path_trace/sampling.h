#pragma once
// Directions and points drawn from densities, in families sample_x / pdf_x. Densities are per solid angle; local
// frames have z up. The methods are those of Pharr, Jakob, Humphreys 2023, appendix A.5, and Duff et al. 2017.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/base/units.h"

namespace daylit {

inline constexpr float kPiF = float(kPi), kInversePi = float(1.0 / kPi);

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

struct SinCos {
    float sine, cosine;
};
/// Of an angle in turns, -1 to 1, within 1e-7; the polynomials are those of Moshier's Cephes. Several times as fast as
/// the library's, without a branch to mispredict, and alike on every processor.
inline SinCos sin_cos_turns(float turns) {
    const float quarters = 4.0f * turns;
    const int nearest = int(quarters + std::copysign(0.5f, quarters));
    const float x = (quarters - float(nearest)) * (0.5f * kPiF), x2 = x * x;
    const float s = x + x * x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f - x2 * 1.9515295891e-4f));
    const float c = 1.0f - 0.5f * x2 +
                    x2 * x2 * (4.166664568298827e-2f + x2 * (-1.388731625493765e-3f + x2 * 2.443315711809948e-5f));
    const auto quadrant = std::uint32_t(nearest);
    const std::uint32_t swap = 0u - (quadrant & 1u), bits = std::bit_cast<std::uint32_t>(s),
                        other = (bits ^ std::bit_cast<std::uint32_t>(c)) & swap;
    const std::uint32_t sine = (bits ^ other) ^ ((quadrant & 2u) << 30);
    const std::uint32_t cosine = (std::bit_cast<std::uint32_t>(c) ^ other) ^ (((quadrant + 1u) & 2u) << 30);
    return {std::bit_cast<float>(sine), std::bit_cast<float>(cosine)};
}

/// atan2(y, x) in turns, -0.5 to 0.5, within 2e-8 of a turn before rounding; 0 for the zero vector. The polynomial
/// interpolates atan at Chebyshev nodes.
inline float turns_of(float y, float x) {
    const float ax = std::abs(x), ay = std::abs(y);
    const float a = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-37f), s = a * a;
    float t = -0.00072571343f;
    for (const float k :
         {0.0037847871f, -0.009363046f, 0.0157067872f, -0.0222869285f, 0.0317784067f, -0.0530492275f, 0.1591549243f})
        t = t * s + k;
    t *= a;
    t = ay > ax ? 0.25f - t : t;
    t = x < 0.0f ? 0.5f - t : t;
    return std::copysign(t, y);
}

inline Vec3 direction_around_z(float cos_theta, float sin_theta, float u) {
    const SinCos phi = sin_cos_turns(u);
    return Vec3(sin_theta * phi.cosine, sin_theta * phi.sine, cos_theta);
}

inline Vec3 sample_cosine_hemisphere(float u, float v) {
    return direction_around_z(std::sqrt(1.0f - u), std::sqrt(u), v);
}
inline float pdf_cosine_hemisphere(float cos_theta) {
    return std::max(cos_theta, 0.0f) * kInversePi;
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

inline constexpr float kBelowOne = 1.0f - 0x1p-24f;

/// True with this chance, by u uniform in [0,1); u is stretched to [0,1) again and can be used on. A chance of 0 or
/// less leaves it as it is.
inline bool choose(float& u, float chance) {
    if (!(chance > 0.0f)) return false;
    const bool chosen = u < chance;
    u = std::min(chosen ? u / chance : (u - chance) / (1.0f - chance), kBelowOne);
    return chosen;
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
/// The same over `chosen`, in one division where the squares are numbers.
inline float power_heuristic_over_pdf(float chosen, float other) {
    if (chosen > 1e-18f && chosen < 1e18f) return chosen / (chosen * chosen + other * other);
    return power_heuristic(chosen, other) / chosen;
}

}  // namespace daylit
