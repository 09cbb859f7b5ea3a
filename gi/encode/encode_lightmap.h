#pragma once
// The day's light at texels as the lightmap that the runtime reads.
#include "engine/baked/day_lightmap.h"
#include "gi/encode/time_basis.h"
#include "gi/surface/texels.h"
#include "gi/transport/day_gather/day_gather.h"

namespace daylit {

struct EncodedLightmap {
    DayLightmap map;
    double error = 0.0;  // of the encoding alone, measured on the halves: worst keyframe, relative
};

/// An hour of a solution, and the parts' scales in its weather.
struct Keyframe {
    std::size_t hour = 0;  // of DayColumns::hours
    LightScales scales;
};

/// What the eye is adapted to at each keyframe, lux: errors are judged against it.
std::vector<double> exposures(const DaySolution& day, std::span<const Keyframe> keyframes);

/// usable   texels that hold light; the rest of each chart's grid is filled from the nearest of these in the chart
EncodedLightmap encode_lightmap(const Atlas& atlas, const Texels& texels, const DaySolution& day,
                                std::span<const Keyframe> keyframes, const std::vector<bool>& usable,
                                const TimeBasisSettings& settings);

}  // namespace daylit
