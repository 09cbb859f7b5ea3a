#pragma once
// The embeddable face of baked light: a host sets the hour, includes shaders/baked_light.glsl in its own program, binds
// texture() to unit 4, and multiplies the irradiance it fetches by albedo / pi. It needs no other part of the renderer.
#include <optional>

#include "engine/baked/day_lightmap.h"
#include "engine/gl/owners.h"
#include "engine/render/programs.h"

namespace daylit {

class BakedLight {
  public:
    /// Uploads the day's components as half floats; the lightmap need not outlive this.
    /// throws Error when the lightmap is larger than the driver's textures.
    explicit BakedLight(const DayLightmap& lightmap);

    /// True when set_hour() would have work to do.
    bool stale(double hour) const;
    /// Combines the components into the irradiance of this hour; does nothing when the weights are the same as before.
    /// Leaves framebuffer, viewport and program changed.
    void set_hour(double hour, Programs& programs);

    /// RGBA16F, lux, *indirect* irradiance; coordinates as DayLightmap::corner_uvs.
    GLuint texture() const { return irradiance_.get(); }

  private:
    DayBasis basis_;
    int width_, height_;
    std::optional<std::vector<float>> weights_;  // of irradiance_
    GlTexture components_, irradiance_;
    GlFramebuffer framebuffer_;
    GlBuffer weights_buffer_;
};

}  // namespace daylit
