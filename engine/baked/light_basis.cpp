#include "engine/baked/light_basis.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

double wrapped(double hour) {
    const double result = hour - 24.0 * std::floor(hour / 24.0);
    return result >= 24.0 ? 0.0 : result;  // a tiny negative hour rounds up to 24
}

/// A blend of as many columns as there are: all of them, or the one that holds all day.
template <class Value>
double blended(const CurveBlend& blend, std::size_t columns, const Value& value) {
    if (columns == 0) return 0.0;
    if (columns == 1) return value(0);
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        if (blend.share[i] != 0.0) sum += blend.share[i] * value(blend.keyframe[i]);
    return sum;
}

}  // namespace

CurveBlend curve_blend(std::span<const double> hours, double hour) {
    CurveBlend blend;
    const std::size_t last = hours.size() - 1;
    if (!(hour > hours.front()) || !(hour < hours.back())) {
        blend.keyframe.fill(hour > hours.front() ? last : 0);
        blend.share[1] = 1.0;
        return blend;
    }
    const std::size_t k = std::size_t(std::upper_bound(hours.begin(), hours.end(), hour) - hours.begin()) - 1;
    blend.keyframe = {k > 0 ? k - 1 : 0, k, k + 1, std::min(k + 2, last)};
    const double step = hours[k + 1] - hours[k], t = (hour - hours[k]) / step;
    // Hermite: values at both ends, and tangents there in units of this step.
    const double h01 = t * t * (3.0 - 2.0 * t), h10 = t * (1.0 - t) * (1.0 - t), h11 = -t * t * (1.0 - t);
    blend.share = {0.0, 1.0 - h01, h01, 0.0};
    // Adds weight * step * slope between keyframes a and b of the blend.
    const auto add_slope = [&](std::size_t a, std::size_t b, double weight) {
        const double share = weight * step / (hours[blend.keyframe[b]] - hours[blend.keyframe[a]]);
        blend.share[b] += share, blend.share[a] -= share;
    };
    if (k > 0) {
        const double before = hours[k] - hours[k - 1];
        add_slope(0, 1, h10 * step / (before + step)), add_slope(1, 2, h10 * before / (before + step));
    } else {
        add_slope(1, 2, h10);
    }
    if (k + 1 < last) {
        const double after = hours[k + 2] - hours[k + 1];
        add_slope(1, 2, h11 * after / (after + step)), add_slope(2, 3, h11 * step / (after + step));
    } else {
        add_slope(1, 2, h11);
    }
    return blend;
}

std::vector<Rgb> LightBasis::weights(const LightScales& scales, double hour) const {
    std::vector<Rgb> result(std::size_t(components), Rgb(0.0f));
    if (hours.empty() || !std::isfinite(hour)) return result;
    const CurveBlend blend = curve_blend(hours, wrapped(hour));
    const double level = std::exp(blended(blend, skies, [&](std::size_t k) { return std::log(double(sky_level[k])); }));
    for (std::size_t r = 0; r < result.size(); ++r) {
        const float* curve = curves.data() + r * columns();
        const float sun = float(blended(blend, suns, [&](std::size_t k) { return double(curve[k]); }));
        const float sky = float(level * blended(blend, skies, [&](std::size_t k) { return double(curve[suns + k]); }));
        result[r] = scales.sun * sun + Rgb(scales.clear * sky) + scales.overcast * curve[still(StillColumn::Overcast)] +
                    scales.ground * curve[still(StillColumn::Ground)] +
                    Rgb(scales.night * curve[still(StillColumn::Night)] +
                        scales.evening * curve[still(StillColumn::Evening)] + curve[still(StillColumn::Lamps)]);
    }
    return result;
}

}  // namespace daylit
