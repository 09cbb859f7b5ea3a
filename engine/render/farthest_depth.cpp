#include "engine/render/farthest_depth.h"

#include <algorithm>
#include <cmath>

namespace daylit {

FarthestDepth::FarthestDepth(int width, int height, std::vector<float> finest) {
    levels_.push_back({width, height, std::move(finest)});
    while (std::max(levels_.back().width, levels_.back().height) > 1) {
        const Level& below = levels_.back();
        Level level{(below.width + 1) / 2, (below.height + 1) / 2, {}};
        level.values.resize(std::size_t(level.width) * std::size_t(level.height));
        for (int y = 0; y < level.height; ++y) {
            const float* a = &below.values[std::size_t(2 * y) * std::size_t(below.width)];
            const float* b = 2 * y + 1 < below.height ? a + below.width : a;
            float* out = &level.values[std::size_t(y) * std::size_t(level.width)];
            for (int x = 0; x < below.width / 2; ++x)
                out[x] = std::max(std::max(a[2 * x], a[2 * x + 1]), std::max(b[2 * x], b[2 * x + 1]));
            if (below.width % 2) out[level.width - 1] = std::max(a[below.width - 1], b[below.width - 1]);
        }
        levels_.push_back(std::move(level));
    }
}

float FarthestDepth::over(const Vec2& min, const Vec2& max) const {
    const auto clamped = [](float x, int size) { return int(std::clamp(std::floor(x), 0.0f, float(size - 1))); };
    const int w = levels_[0].width, h = levels_[0].height;
    const int x0 = clamped(min.x, w), y0 = clamped(min.y, h), x1 = clamped(max.x, w), y1 = clamped(max.y, h);
    int k = 0;
    while (std::max((x1 >> k) - (x0 >> k), (y1 >> k) - (y0 >> k)) > 3) ++k;
    const Level& level = levels_[std::size_t(k)];
    float farthest = 0.0f;
    for (int y = y0 >> k; y <= y1 >> k; ++y)
        for (int x = x0 >> k; x <= x1 >> k; ++x)
            farthest = std::max(farthest, level.values[std::size_t(y) * std::size_t(level.width) + std::size_t(x)]);
    return farthest;
}

}  // namespace daylit
