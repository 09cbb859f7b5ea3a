#pragma once
// The day's light, reduced: what the gather hands over to the encoders.
#include <glm/vec3.hpp>
#include <vector>

#include "engine/base/units.h"
#include "gi/transport/day_gather/day_columns.h"

namespace daylit {

/// Few components stand for all columns:
///     value(row, column) = sum over r of component(row, r) * curve(r, column)
/// Rows may be negative by a little where the sum of few components swings about zero.
struct DayBasisCurves {
    DayColumns columns;
    std::size_t components = 0;
    std::vector<float> curves;  // components * columns.count()
    double error = 0.0;         // of the components alone, measured on rows that they were not chosen by: RMS of all
                                // columns, each worth what it gives on a clear day, over RMS of the light

    float curve(std::size_t component, std::size_t column) const {
        return curves[component * columns.count() + column];
    }
    /// What the components are multiplied by at hour `columns.hours[k]`:
    ///     light(row) = sum over r of component(row, r) * weights[r]
    std::vector<Rgb> weights(std::size_t k, const LightScales& scales) const;
    /// Which component is a still column and nothing else, with curve 1 (every still column has one).
    std::size_t component_of(StillPart part) const { return components - kStillParts + std::size_t(part); }
};

struct DaySolution {
    DayBasisCurves basis;
    /// *Indirect* irradiance of each texel's front, lux: [texel][component]. Buried texels are black.
    std::vector<Rgb> texels;
    /// All light, direct and indirect, that leaves a receiver or comes from a sky bin, as pi L (lux): [receivers of
    /// GatherHits, then sky bins][component]. Emission is not in it: rays add it where they meet emitters, as component
    /// Evening or Lamps. Other receivers gather from this at will; a ray's hit is an index into it once kSkyBit is
    /// replaced by the number of receivers.
    std::vector<Rgb> leaving;
    /// Mean over all fronts of the light that leaves them, lux: per column.
    std::vector<glm::dvec3> mean_leaving;
    int bounces = 0;

    const Rgb* texel(std::size_t t) const { return texels.data() + t * basis.components; }
    const Rgb* leaves(std::size_t receiver_or_bin) const { return leaving.data() + receiver_or_bin * basis.components; }
    /// Mean luminance of what leaves the fronts at hour `columns.hours[k]`, lux: what an eye is adapted to.
    double mean_luminance(std::size_t k, const LightScales& scales) const;
};

}  // namespace daylit
