#pragma once
// Look-up of many places at once in an irradiance volume, for hosts that light things on the CPU.
#include <span>
#include <vector>

#include "engine/baked/irradiance_volume.h"

namespace daylit {

/// Irradiance on the two sides of a plane.
struct TwoSided {
    Rgb front, back;
};

/// A volume at one moment, its records laid out for SIMD: the numbers of one part follow one another, in rows of whole
/// registers.
class VolumeBatch {
  public:
    /// What the light belongs to must outlive this; the light itself need not.
    explicit VolumeBatch(const VolumeLight& light);

    /// One place and unit normal each; as VolumeLight::irradiance(), up to the order of sums (1e-5 of the brightest).
    void irradiance(std::span<const Vec3> places, std::span<const Vec3> normals, std::span<Rgb> out) const;
    /// The same with the light of the side that the normal turns away from, for little more than one side's price.
    void two_sided(std::span<const Vec3> places, std::span<const Vec3> normals, std::span<TwoSided> out) const;

  private:
    template <class Use>
    void look_up(std::span<const Vec3> places, const Use& use) const;

    const VolumeTree& tree_;
    std::vector<float> rows_;  // [record][part 4][kVolumeNumbers, padded]
};

}  // namespace daylit
