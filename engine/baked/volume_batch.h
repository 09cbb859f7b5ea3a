#pragma once
// Look-up of many places at once in an irradiance volume, for hosts that light things on the CPU.
#include <span>
#include <vector>

#include "engine/baked/irradiance_volume.h"

namespace daylit {

/// A volume at one moment, its records laid out for SIMD: the numbers of one part follow one another, in rows of whole
/// registers.
class VolumeBatch {
  public:
    /// What the light belongs to must outlive this; the light itself need not.
    explicit VolumeBatch(const VolumeLight& light);

    /// One place and unit normal each; as VolumeLight::irradiance(), up to the order of sums (1e-5 of the brightest).
    void irradiance(std::span<const Vec3> places, std::span<const Vec3> normals, std::span<Rgb> out) const;

  private:
    const VolumeTree& tree_;
    std::vector<float> rows_;  // [record][part 4][kVolumeNumbers, padded]
};

}  // namespace daylit
