#pragma once
// From light at keyframes to a few components and their curves.
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "engine/baked/day_basis.h"
#include "engine/base/units.h"

namespace daylit {

struct TimeBasisSettings {
    int max_components = 32;
    double error = 0.02;  // relative error of the worst keyframe at which no further component is added
};

/// The light of all rows at all keyframes, asked for row by row (called from several threads).
struct DayRows {
    std::size_t count = 0;
    std::vector<double> hours;  // keyframes
    std::vector<double>
        exposure;  // per keyframe, lux: the light that the eye is adapted to; errors are judged against it
    std::function<void(std::size_t row, Rgb* keyframes)> read;  // lux
};

struct TimeBasis {
    std::vector<double> hours;
    std::vector<double> exposure;
    int components = 0;
    std::vector<double> vectors;  // components * keyframes, orthonormal rows over light divided by exposure
    double error = 0.0;  // relative error of the worst keyframe: RMS over rows, each judged at its own brightness
};

/// Principal components over time (Bahnsen et al.), exact and streaming: only the keyframes x keyframes Gram matrix is
/// kept, summed in doubles in fixed order. Columns are divided by exposure, so that dusk counts as much as noon, and
/// rows by their own mean over the day, so that a dark room counts as much as the courtyard.
TimeBasis fit_time_basis(const DayRows& rows, const TimeBasisSettings& settings);

/// The components of one row; components = basis.components.
void project(const TimeBasis& basis, const Rgb* keyframes, Rgb* components);

/// The curves as stored; scale[r] is what component images were divided by.
DayBasis day_basis(const TimeBasis& basis, std::span<const float> scale);

/// Worst keyframe's relative error of what `look_up` (row, weights at the keyframe) gives, measured like
/// TimeBasis::error: rounding to halves and clamping included.
double measure_error(const DayRows& rows, const DayBasis& basis,
                     const std::function<Rgb(std::size_t row, std::span<const float> weights)>& look_up);

}  // namespace daylit
