#pragma once
// Shadow maps of punctual lamps: six square maps around a point lamp, one for a spot; kept until the lamp, or something
// that it shines on, has moved.
#include <span>
#include <vector>

#include "engine/render/draw_scene.h"
#include "shaders/shared/frame_block.h"

namespace daylit {

/// One map: looking along z from the lamp, tan_half to each side.
struct LampMap {
    std::size_t lamp;
    Vec3 x, z;  // unit; y is cross(z, x)
};

/// The maps of a lamp, in the order of their layers, and the lamp's block with everything but its first layer.
struct LampFit {
    glsl::LampBlock block;
    float tan_half;  // of the angle that each map spans
    bool moves = false;
    std::vector<LampMap> maps;
};
LampFit fit_lamp(const PlacedLight& lamp, std::size_t number, int texels);

/// clip_from_world with reversed infinite depth: near / distance along z.
Mat4 lamp_matrix(const LampFit& fit, const LampMap& map);

class LampShadow {
  public:
    /// Point and spot lamps only. True when some map must be drawn again.
    bool plan(std::span<const PlacedLight> lamps, const DrawScene& scene);
    DrawCount draw(DrawScene& scene);

    int maps_drawn() const { return maps_drawn_; }
    std::size_t lamp_count() const { return fits_.size(); }
    /// Lamps to uniform block 2, their maps to unit 8.
    void use(glsl::FrameBlock& frame);

    bool any_spots() const;

  private:
    /// Which clusters of what stands each standing lamp sees, past what stands alone (a door may open).
    void find_lit_clusters(DrawScene& scene);

    std::vector<LampFit> lit_;
    std::uint64_t lit_version_ = 0;
    std::vector<LampFit> fits_, drawn_;
    std::vector<bool> stale_;  // by layer
    std::uint64_t drawn_version_ = 0;
    int texels_ = 0, layers_ = 0, maps_drawn_ = 0;
    int texture_texels_ = 0, texture_layers_ = 0;
    GlTexture depth_;
    GlFramebuffer framebuffer_;
    GlBuffer block_;
};

}  // namespace daylit
