#pragma once
// The embeddable face of baked light: a host sets the light, includes shaders/baked_light.glsl in its own program,
// calls bind(), and multiplies the irradiance it fetches by albedo / pi. It needs no other part of the renderer.
#include <vector>

#include "engine/baked/day_lightmap.h"
#include "engine/gl/owners.h"
#include "engine/render/programs.h"
#include "engine/render/relit_tiles.h"

namespace daylit {

class BakedLight {
  public:
    /// Uploads the texels as half floats (exact); the lightmap need not outlive this.
    /// throws Error when the lightmap is larger than the driver's textures.
    explicit BakedLight(const DayLightmap& lightmap);

    /// Where the surfaces stand that each tile lights (tile_bounds()); until it is told, every tile counts as seen.
    void set_bounds(std::vector<Bounds> tiles) { relit_.set_bounds(std::move(tiles)); }

    /// True when this is not the light of the last set_light().
    bool stale(const LightScales& scales, double hour) const;
    /// True when tiles in view were not in view since the light changed.
    bool unlit(const Frustum& seen) const { return relit_.any_unlit(seen); }
    /// Combines the patterns of the tiles in view into the irradiance of this light, of those only that do not have it
    /// yet. Leaves framebuffer, viewport and program changed. Returns the number of tiles that were worked out.
    int set_light(const LightScales& scales, double hour, const Frustum& seen, Programs& programs);

    /// RGBA16F, lux, *indirect* irradiance; coordinates as DayLightmap::corner_uvs.
    GLuint texture() const { return irradiance_.get(); }
    /// Whether texels under normal maps know how light changes as the normal leans: programs may define TILTED.
    bool tilted() const { return tilts_[0].get() != 0; }
    /// Binds what shaders/baked_light.glsl reads: texture units 4, 10 and 11.
    void bind() const;

  private:
    bool plain(std::uint32_t tile) const { return map_.tile_tilted.empty() || !map_.tile_tilted[tile]; }  // no tilts
    void upload(std::vector<Rgb> weights);

    DayLightmap map_;           // without texels and coordinates
    std::vector<Rgb> weights_;  // of the light that relit_ is about
    bool lit_ = false;
    RelitTiles relit_{{}};  // those without tilts first
    GlTexture values_, irradiance_, tilts_[2];
    GlFramebuffer framebuffer_, tilted_framebuffer_;
    GlBuffer light_buffer_, tile_buffer_;
};

}  // namespace daylit
