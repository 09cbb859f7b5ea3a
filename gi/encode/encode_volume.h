#pragma once
// The day's light in free space as the volume that the runtime reads.
#include <memory>
#include <string>
#include <vector>

#include "engine/baked/irradiance_volume.h"
#include "gi/encode/light_rows.h"
#include "gi/encode/volume_refine.h"
#include "gi/surface/reachable.h"
#include "gi/transport/day_gather/probe_light.h"

namespace daylit {

struct EncodedVolume {
    IrradianceVolume volume;
    double error = 0.0;  // of places measured inside cells against what the volume gives there at judged moments: RMS
                         // over mean; of Adini alone
    std::size_t samples = 0;     // traced
    std::size_t unmeasured = 0;  // records whose corner lies in a wall
    double window = 0.0;         // largest lambda of the windows that took away negative light
    std::vector<std::string>
        buried;                 // dynamic nodes that rest inside of something solid, lit as the nearest open place
    bool budget_spent = false;  // cells ran out before errors did
    std::vector<float> records;  // as store_records() rounds them; of an encoder that keeps samples alone
};

/// Encodes one solution's light, once or for several settings that are to be compared. Everything handed over must
/// outlive this.
class VolumeEncoder {
  public:
    /// settings       rays and seed of samples; encode() takes the rest
    /// keep_samples   so that later encodings trace no place again, and other steps need no other fit
    VolumeEncoder(const Scene& scene, const Reachable& reachable, const GatherScene& gather, const GatherHits& hits,
                  const LightBasis& light, const LeavingLight& leaving, std::span<const Moment> moments,
                  const VolumeSettings& settings, const BasisSettings& basis, bool keep_samples = false);
    ~VolumeEncoder();

    /// throws Error when the cells that settings ask for cannot be afforded.
    EncodedVolume encode(const VolumeSettings& settings, const StageProgress& progress) const;
    /// Roots along x, y, z.
    std::array<int, 3> roots() const;
    /// What the gather itself says: radiance SH at a place in the components of the light that was handed over,
    /// [coefficient * 3 + channel][component].
    std::vector<float> gathered(const Vec3& place, std::uint64_t key, int rays) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace daylit
