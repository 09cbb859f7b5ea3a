#pragma once
// The day's radiance at probes as the volume that the runtime reads.
#include "engine/baked/irradiance_volume.h"
#include "gi/encode/time_basis.h"
#include "gi/surface/probe_grid.h"
#include "gi/transport/day_gather/day_gather.h"

namespace daylit {

/// An hour of a solution, and the parts' scales in its weather.
struct Keyframe {
    std::size_t hour = 0;  // of DayColumns::hours
    LightScales scales;
};

struct EncodedVolume {
    IrradianceVolume volume;
    double error = 0.0;      // of the encoding alone, measured on the halves: worst keyframe's irradiance, relative
    std::size_t buried = 0;  // probes that were traced and found inside solid geometry
};

/// probes     the grid's wanted ones, in their order
EncodedVolume encode_volume(const ProbeGrid& grid, const ProbeHits& probes, const DaySolution& day,
                            std::span<const Keyframe> keyframes, const TimeBasisSettings& settings);

}  // namespace daylit
