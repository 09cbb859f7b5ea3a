#pragma once
// Which few components stand for all hours of sun and sky.
#include <cstddef>
#include <vector>

#include "gi/transport/day_gather/day_columns.h"

namespace daylit {

/// The columns of sun and sky (no still ones) of some rows, in full.
struct SampleRows {
    std::size_t columns = 0;
    std::vector<float> values;  // [row][channel][column], lux

    std::size_t count() const { return columns ? values.size() / (3 * columns) : 0; }
    const float* row(std::size_t i) const { return values.data() + i * 3 * columns; }
    float* row(std::size_t i) { return values.data() + i * 3 * columns; }
};

struct Reduction {
    std::size_t components = 0;
    std::vector<float> project;  // [column][component]: component = sum over columns of value * project
    std::vector<float> curves;   // [component][column]
    double error = 0.0;          // as DayBasisCurves::error
};

struct ReductionSettings {
    std::size_t most = kMostComponents - kStillParts;  // components; at least 3
    double error = 0.003;
};

/// Principal components of the sample's rows in time. Columns are worth what they give on a clear day, over
/// `exposure` (lux, per hour), so that dusk counts as much as noon; rows count by their own mean brightness, so that a
/// dark room counts as much as the courtyard. With a single hour: every column by itself.
/// check   other rows, on which the error is measured
Reduction reduce(const DayLight& light, const SampleRows& sample, const SampleRows& check,
                 const std::vector<double>& exposure, const ReductionSettings& settings = {});

/// Luminance of a row at every hour of a clear day, still parts left out.
std::vector<double> clear_day(const DayLight& light, const float* row);

}  // namespace daylit
