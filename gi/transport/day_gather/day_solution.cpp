#include "gi/transport/day_gather/day_solution.h"

namespace daylit {

std::vector<Rgb> DayBasisCurves::weights(std::size_t k, const LightScales& scales) const {
    std::vector<Rgb> result(components, Rgb(0.0f));
    columns.for_hour(k, scales, [&](std::size_t column, const Rgb& scale) {
        for (std::size_t r = 0; r < components; ++r) result[r] += curve(r, column) * scale;
    });
    return result;
}

double DaySolution::mean_luminance(std::size_t k, const LightScales& scales) const {
    double sum = 0.0;
    basis.columns.for_hour(k, scales, [&](std::size_t column, const Rgb& scale) {
        sum += double(luminance(Rgb(mean_leaving[column]) * scale));
    });
    return sum;
}

}  // namespace daylit
