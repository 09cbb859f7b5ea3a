#include "engine/render/farthest_depth.h"

#include <algorithm>
#include <cmath>

namespace daylit {

FarthestDepth::FarthestDepth(int side, std::vector<float> finest) : side_(side), levels_{std::move(finest)} {
    for (int s = side / 2; s >= 1; s /= 2) {
        const std::vector<float>& below = levels_.back();
        std::vector<float> level(std::size_t(s) * std::size_t(s));
        for (int y = 0; y < s; ++y)
            for (int x = 0; x < s; ++x) {
                const float* a = &below[std::size_t(4 * s * y + 2 * x)];
                const float* b = a + 2 * s;
                level[std::size_t(s * y + x)] = std::max(std::max(a[0], a[1]), std::max(b[0], b[1]));
            }
        levels_.push_back(std::move(level));
    }
}

float FarthestDepth::over(const Vec2& min, const Vec2& max) const {
    const auto clamped = [&](float x) { return int(std::clamp(std::floor(x), 0.0f, float(side_ - 1))); };
    const int x0 = clamped(min.x), y0 = clamped(min.y), x1 = clamped(max.x), y1 = clamped(max.y);
    int level = 0;
    while (std::max((x1 >> level) - (x0 >> level), (y1 >> level) - (y0 >> level)) > 3) ++level;
    const std::vector<float>& values = levels_[std::size_t(level)];
    float farthest = 0.0f;
    for (int y = y0 >> level; y <= y1 >> level; ++y)
        for (int x = x0 >> level; x <= x1 >> level; ++x)
            farthest = std::max(farthest, values[std::size_t((side_ >> level) * y + x)]);
    return farthest;
}

}  // namespace daylit
