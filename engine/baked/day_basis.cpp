#include "engine/baked/day_basis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace daylit {
namespace {

struct Between {
    std::size_t below, above;
    double share;  // of `above`
};

/// Where an hour lies among the keyframes.
Between locate(const std::vector<double>& hours, double hour) {
    const auto above = std::upper_bound(hours.begin(), hours.end(), hour);
    if (above == hours.begin()) return {0, 0, 0.0};
    const std::size_t below = std::size_t(above - hours.begin()) - 1;
    if (above == hours.end()) return {below, below, 0.0};
    return {below, below + 1, (hour - hours[below]) / (hours[below + 1] - hours[below])};
}

}  // namespace

std::vector<float> DayBasis::weights(double hour) const {
    std::vector<float> result(std::size_t(components), 0.0f);
    if (hours.empty() || !std::isfinite(hour)) return result;
    double wrapped = hour - 24.0 * std::floor(hour / 24.0);
    if (wrapped >= 24.0) wrapped = 0.0;  // a tiny negative hour rounds up to 24
    const Between at = locate(hours, wrapped);
    for (std::size_t r = 0; r < result.size(); ++r) {
        const float* curve = curves.data() + r * hours.size();
        result[r] = float((1.0 - at.share) * curve[at.below] + at.share * curve[at.above]);
    }
    return result;
}

}  // namespace daylit
