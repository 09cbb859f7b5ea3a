#pragma once
// Which cells of a grid have their centres in a triangle; cost grows with rows and cells found, not with the rectangle
// around a long sliver.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/units.h"

namespace daylit {

/// The triangle with its corners in counter-clockwise order.
inline std::array<Vec2, 3> counter_clockwise(std::array<Vec2, 3> p) {
    const glm::dvec2 e = glm::dvec2(p[1]) - glm::dvec2(p[0]), f = glm::dvec2(p[2]) - glm::dvec2(p[0]);
    if (e.x * f.y < e.y * f.x) std::swap(p[1], p[2]);
    return p;
}

/// Calls cell(x, y), integers, for each cell of size 1 whose centre (x + 0.5, y + 0.5) lies in the counter-clockwise
/// triangle p, at least `inset` away from its edges (twice the area that the edge and the centre span; negative:
/// outside counts). Row by row, left to right. cell returns false to stop.
template <class F>
void for_cells_inside(const std::array<Vec2, 3>& p, double inset, F&& cell) {
    const double low = std::min({p[0].y, p[1].y, p[2].y}), high = std::max({p[0].y, p[1].y, p[2].y});
    const double left = std::min({p[0].x, p[1].x, p[2].x}), right = std::max({p[0].x, p[1].x, p[2].x});
    for (long y = std::lround(std::ceil(low - 0.5)); double(y) + 0.5 <= high; ++y) {
        const double cy = double(y) + 0.5;
        double from = left, to = right;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 q = p[k], e = glm::dvec2(p[(k + 1) % 3]) - q;
            const double rest = e.x * (cy - q.y) - inset;  // inside: rest > e.y (cx - q.x)
            if (e.y > 0.0) to = std::min(to, q.x + rest / e.y);
            else if (e.y < 0.0) from = std::max(from, q.x + rest / e.y);
            else if (rest < 0.0) to = from - 1.0;
        }
        for (long x = std::lround(std::ceil(from - 0.5)); double(x) + 0.5 <= to; ++x)
            if (!cell(x, y)) return;
    }
}

}  // namespace daylit
