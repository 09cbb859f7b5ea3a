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

/// What the eye is adapted to at each keyframe, lux: errors are judged against it.
std::vector<double> exposures(const DayIrradiance& day);

/// hours    of day's columns but the last, which is added to each
/// usable   texels that hold light; the rest of each chart's grid is filled from the nearest of these in the chart
EncodedLightmap encode_lightmap(const Atlas& atlas, const Texels& texels, const DayIrradiance& day,
                                std::span<const double> hours, const std::vector<bool>& usable,
                                const TimeBasisSettings& settings);

}  // namespace daylit
