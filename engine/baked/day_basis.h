#pragma once
// One time basis for everything that is stored per receiver: a row of light over the day is a sum of few components
// whose weights are curves of the hour.
#include <vector>

namespace daylit {

/// value(receiver, hour) = sum over r of component(receiver, r) * weight_r(hour).
struct DayBasis {
    std::vector<double> hours;  // keyframes, ascending, local clock hours; one keyframe: the light never changes
    int components = 0;
    std::vector<float> curves;  // components * hours.size(), one row per component: its weight at each keyframe

    /// The weights of all components at an hour (any real number, wrapped to [0,24)): linear between keyframes in the
    /// thin first form, held constant outside them.
    std::vector<float> weights(double hour) const;
};

}  // namespace daylit
