#pragma once
// The day's light in free space as the volume that the runtime reads.
#include <string>
#include <vector>

#include "engine/baked/irradiance_volume.h"
#include "gi/encode/light_rows.h"
#include "gi/encode/volume_refine.h"
#include "gi/transport/day_gather/probe_light.h"

namespace daylit {

struct EncodedVolume {
    IrradianceVolume volume;
    double error =
        0.0;  // of places measured inside cells against what the volume gives there at judged moments: RMS over mean
    std::size_t samples = 0;     // traced
    std::size_t unmeasured = 0;  // records whose corner lies in a wall
    double window = 0.0;         // largest lambda of the windows that took away negative light
    std::vector<std::string>
        buried;                 // dynamic nodes that rest inside of something solid, lit as the nearest open place
    bool budget_spent = false;  // cells ran out before errors did
};

/// Where light is wanted: what cameras and moving things can reach, and open air.
EncodedVolume encode_volume(const Scene& scene, const GatherScene& gather, const GatherHits& hits,
                            const LightBasis& light, const LeavingLight& leaving, std::span<const Moment> moments,
                            const VolumeSettings& settings, const BasisSettings& basis, const StageProgress& progress);

}  // namespace daylit
