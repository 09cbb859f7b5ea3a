#pragma once
// Baked light for what moves: a host sets the hour, includes shaders/baked_volume.glsl in its own program, calls
// bind(), and multiplies the irradiance it looks up by albedo / pi.
#include <optional>

#include "engine/baked/irradiance_volume.h"
#include "engine/gl/owners.h"

namespace daylit {

class BakedVolume {
  public:
    /// The volume must outlive this. throws Error when it is larger than the driver's buffers.
    explicit BakedVolume(const IrradianceVolume& volume);

    /// True when set_light() would have work to do.
    bool stale(const LightScales& scales, double hour) const;
    /// Uploads the records of this moment; does nothing when they are the same as before.
    void set_light(const LightScales& scales, double hour);
    /// The look-up on the CPU, of the moment last set; null before.
    const VolumeLight* light() const { return light_ ? &*light_ : nullptr; }
    /// Binds what the shader reads: uniform block 3 and storage blocks 4 to 7.
    void bind() const;

  private:
    const IrradianceVolume& volume_;
    std::optional<std::vector<Rgb>> weights_;  // of records_
    std::optional<VolumeLight> light_;
    GlBuffer grid_, nodes_, cells_, cuts_, records_;
};

}  // namespace daylit
