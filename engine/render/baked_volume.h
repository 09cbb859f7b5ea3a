#pragma once
// Baked light for what moves: a host sets the hour, includes shaders/baked_volume.glsl in its own program, calls
// bind(), and multiplies the irradiance it looks up by albedo / pi.
#include <optional>

#include "engine/baked/volume_batch.h"
#include "engine/gl/owners.h"

namespace daylit {

class BakedVolume {
  public:
    /// The volume must outlive this. throws Error when it is larger than the driver's buffers.
    explicit BakedVolume(const IrradianceVolume& volume);

    /// True when set_light() would have work to do.
    bool stale(const LightScales& scales, double hour) const;
    /// Works out the records of this moment; does nothing when they are the same as before.
    void set_light(const LightScales& scales, double hour);
    const VolumeTree& tree() const { return volume_.tree; }
    /// Look-ups on the CPU, of the moment last set; after set_light().
    const VolumeLight& light() const { return *light_; }
    const VolumeBatch& batch();
    /// Binds what the shader reads: uniform block 3 and storage blocks 4 to 7. Uploads what is not there yet, so a host
    /// whose shaders look nothing up need not call it.
    void bind();

  private:
    const IrradianceVolume& volume_;
    std::optional<std::vector<Rgb>> weights_;  // of light_
    std::optional<VolumeLight> light_;
    std::optional<VolumeBatch> batch_;  // made when first asked for
    bool uploaded_ = false;             // records_ are those of light_
    GlBuffer grid_, nodes_, cells_, cuts_, records_;
};

}  // namespace daylit
