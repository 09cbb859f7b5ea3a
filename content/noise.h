#pragma once
// Tileable noise for textures: pure functions of place and seed.
#include <cmath>
#include <cstdint>

#include "engine/base/random.h"
#include "engine/base/units.h"

namespace daylit::content {

/// Uniform in [0,1) for a lattice cell.
inline float hash_cell(int x, int y, std::uint32_t seed) {
    return float(mix64((std::uint64_t(seed) << 48) ^ (std::uint64_t(std::uint32_t(x)) << 24) ^ std::uint32_t(y)) >> 40) *
           0x1p-24f;
}

inline int wrap(int i, int period) {
    return (i % period + period) % period;
}

/// Value noise in [0,1], smooth, one lattice step per unit, repeating after `period` steps in each direction.
inline float value_noise(Vec2 p, int period_x, int period_y, std::uint32_t seed) {
    const float fx = std::floor(p.x), fy = std::floor(p.y);
    const int x = int(fx), y = int(fy);
    Vec2 t = p - Vec2(fx, fy);
    t = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
    const auto at = [&](int i, int j) { return hash_cell(wrap(x + i, period_x), wrap(y + j, period_y), seed); };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), t.x), glm::mix(at(0, 1), at(1, 1), t.x), t.y);
}

/// Octaves of value noise over the unit square, repeating; `cells` lattice steps across for the first. In [0,1].
inline float fractal_noise(Vec2 uv, int cells_x, int cells_y, int octaves, std::uint32_t seed) {
    float sum = 0.0f, amplitude = 0.5f, total = 0.0f;
    for (int o = 0; o < octaves; ++o) {
        sum += amplitude * value_noise(uv * Vec2(cells_x, cells_y), cells_x, cells_y, seed + std::uint32_t(o) * 101u);
        total += amplitude;
        amplitude *= 0.5f;
        cells_x *= 2;
        cells_y *= 2;
    }
    return sum / total;
}

/// Distances to the nearest and second nearest of one random point per cell, in cells, repeating over the unit square;
/// `id` is a random number of the nearest point (Worley 1996).
struct Worley {
    float first = 9.0f, second = 9.0f, id = 0.0f;
};
inline Worley worley(Vec2 uv, int cells, std::uint32_t seed, float jitter = 1.0f) {
    const Vec2 p = uv * float(cells);
    const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
    Worley w;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const int cx = wrap(x + i, cells), cy = wrap(y + j, cells);
            const Vec2 offset(hash_cell(cx, cy, seed), hash_cell(cx, cy, seed + 7u));
            const Vec2 point = Vec2(x + i, y + j) + glm::mix(Vec2(0.5f), offset, jitter);
            const float d = glm::length(point - p);
            if (d < w.first) {
                w.second = w.first;
                w.first = d;
                w.id = hash_cell(cx, cy, seed + 13u);
            } else {
                w.second = std::min(w.second, d);
            }
        }
    return w;
}

}  // namespace daylit::content
