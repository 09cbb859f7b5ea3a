#pragma once
// What the encoders are given: the light of rows in the gather's reduced form, and the moments it is judged at.
#include <span>
#include <vector>

#include "engine/baked/light_basis.h"
#include "engine/base/units.h"
#include "gi/transport/day_gather/day_solution.h"

namespace daylit {

/// A light that somebody may look at: an hour, how strong each part shines, and what the eye is adapted to then.
struct Moment {
    double hour = 12.0;
    LightScales scales;
    double exposure = 1.0;  // lux of reflected light; errors are judged against it
};

struct LightRows {
    LightBasis light;           // with a keyframe at every hour that was solved for
    int lobes = 1;              // numbers that a row holds: 1, irradiance; 4, SH of two bands
    std::span<const Rgb> rows;  // [row][lobe][component]
    std::vector<Moment> moments;

    std::size_t stride() const { return std::size_t(lobes) * std::size_t(light.components); }
    std::size_t count() const { return stride() ? rows.size() / stride() : 0; }
    const Rgb* row(std::size_t i) const { return rows.data() + i * stride(); }
};

/// How much of a stored basis may be wrong.
struct BasisSettings {
    double dropped = 5e-4;    // relative error that leaving out components may bring
    double keyframes = 4e-3;  // relative error, of any moment, that curves between keyframes may bring
};

/// The gather's components and curves.
LightBasis light_basis(const DayBasisCurves& curves);

/// Every hour that was solved for on a clear day; some under full cloud; and the night.
std::vector<Moment> moments(const DaySolution& day, const LightModel& light);

}  // namespace daylit
