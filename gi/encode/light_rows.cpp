#include "gi/encode/light_rows.h"

#include <algorithm>

namespace daylit {
namespace {

// Luminance times pi to which displays adapt at the least (the floor of auto_ev).
constexpr double kDarkestExposure = 1e-4 * kPi;
constexpr std::size_t kCloudyEvery = 12;  // hours of those solved for: clouds have no direction that would move

}  // namespace

LightBasis light_basis(const DayBasisCurves& curves) {
    LightBasis basis;
    basis.hours = curves.columns.hours;
    basis.suns = curves.columns.suns, basis.skies = curves.columns.skies;
    basis.sky_level.assign(basis.skies, 1.0f);
    basis.components = int(curves.components);
    basis.curves = curves.curves;
    return basis;
}

std::vector<Moment> moments(const DaySolution& day, const LightModel& light) {
    std::vector<Moment> result;
    const std::vector<double>& hours = day.basis.columns.hours;
    const auto add = [&](std::size_t k, const LightScales& scales) {
        result.push_back({hours[k], scales, std::max(day.mean_luminance(k, scales), kDarkestExposure)});
    };
    for (std::size_t k = 0; k < hours.size(); ++k) add(k, light.scales(hours[k], 0.0));
    if (light.constant()) return result;
    for (std::size_t k = kCloudyEvery; k < hours.size(); k += kCloudyEvery) add(k, light.scales(hours[k], 1.0));
    add(0, {.night = 1.0f, .evening = 1.0f});
    return result;
}

}  // namespace daylit
