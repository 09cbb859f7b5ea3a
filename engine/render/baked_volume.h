#pragma once
// Baked light for what moves: a host sets the hour, includes shaders/baked_volume.glsl in its own program, calls
// bind(), and multiplies the irradiance it looks up by albedo / pi.
#include <optional>

#include "engine/baked/irradiance_volume.h"
#include "engine/gl/owners.h"

namespace daylit {

class BakedVolume {
  public:
    /// The volume must outlive this. throws Error when it is larger than the driver's textures.
    explicit BakedVolume(const IrradianceVolume& volume);

    /// True when set_hour() would have work to do.
    bool stale(double hour) const;
    /// Uploads the SH of this hour; does nothing when the weights are the same as before.
    void set_hour(double hour);
    /// Binds what the shader reads: texture unit 10 and uniform block 3.
    void bind() const;

  private:
    const IrradianceVolume& volume_;
    std::optional<std::vector<float>> weights_;  // of sh_
    GlTexture sh_;  // RGBA32F (halves might overflow under bright skies), the nine coefficients stacked along y
    GlBuffer grid_;
};

}  // namespace daylit
