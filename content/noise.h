#pragma once
// Tileable noise for textures: pure functions of place and seed.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/base/units.h"

namespace daylit::content {

/// Uniform in [0,1) for a lattice cell (two rounds of multiply and xorshift, as in Wellons' low-bias hashes).
inline float hash_cell(int x, int y, std::uint32_t seed) {
    std::uint32_t h = std::uint32_t(x) * 0x8DA6B343u + std::uint32_t(y) * 0xD8163841u + seed * 0xCB1AB31Fu;
    h = (h ^ (h >> 16)) * 0x7FEB352Du;
    h = (h ^ (h >> 15)) * 0x846CA68Bu;
    return float((h ^ (h >> 16)) >> 8) * 0x1p-24f;
}

inline int wrap(int i, int period) {
    if (i >= 0 && i < period) return i;  // nearly always
    return (i % period + period) % period;
}

/// Value noise in [0,1], smooth, one lattice step per unit, repeating after `period` steps in each direction.
inline float value_noise(Vec2 p, int period_x, int period_y, std::uint32_t seed) {
    const float fx = std::floor(p.x), fy = std::floor(p.y);
    const int x = int(fx), y = int(fy);
    Vec2 t = p - Vec2(fx, fy);
    t = t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
    const int x0 = wrap(x, period_x), x1 = wrap(x0 + 1, period_x), y0 = wrap(y, period_y), y1 = wrap(y0 + 1, period_y);
    return glm::mix(glm::mix(hash_cell(x0, y0, seed), hash_cell(x1, y0, seed), t.x),
                    glm::mix(hash_cell(x0, y1, seed), hash_cell(x1, y1, seed), t.x), t.y);
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
