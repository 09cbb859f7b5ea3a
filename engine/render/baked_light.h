#pragma once
// The embeddable face of baked light: a host sets the light, includes shaders/baked_light.glsl in its own program,
// calls bind(), and multiplies the irradiance it fetches by albedo / pi. It needs no other part of the renderer.
#include <vector>

#include "engine/baked/day_lightmap.h"
#include "engine/gl/owners.h"
#include "engine/render/programs.h"

namespace daylit {

class BakedLight {
  public:
    /// Uploads the texels as half floats (exact); the lightmap need not outlive this.
    /// throws Error when the lightmap is larger than the driver's textures.
    explicit BakedLight(const DayLightmap& lightmap);

    /// True when set_light() would have work to do.
    bool stale(const LightScales& scales, double hour) const;
    /// Combines the patterns of all tiles into the irradiance of this light; does nothing when it is the same as
    /// before. Leaves framebuffer, viewport and program changed. Returns the number of tiles that were worked out.
    int set_light(const LightScales& scales, double hour, Programs& programs);

    /// RGBA16F, lux, *indirect* irradiance; coordinates as DayLightmap::corner_uvs.
    GLuint texture() const { return irradiance_.get(); }
    /// Whether texels under normal maps know how light changes as the normal leans: programs may define TILTED.
    bool tilted() const { return tilts_[0].get() != 0; }
    /// Binds what shaders/baked_light.glsl reads: texture units 4, 10 and 11.
    void bind() const;

  private:
    DayLightmap map_;           // without texels and coordinates
    std::vector<Rgb> weights_;  // of irradiance_; empty: not lit yet
    bool lit_ = false;
    std::vector<std::uint32_t> tiles_;  // that hold light, those without tilts first
    std::size_t plain_tiles_ = 0;       // that have no tilts
    GlTexture values_, irradiance_, tilts_[2];
    GlFramebuffer framebuffer_, tilted_framebuffer_;
    GlBuffer light_buffer_, tile_buffer_;
};

}  // namespace daylit
