#pragma once
// Shadow maps of punctual lamps: six square maps around a point lamp, one for a spot; kept until the lamp, or something
// that it shines on, has moved.
#include <span>
#include <vector>

#include "engine/render/lamp_fit.h"
#include "engine/render/lit_clusters.h"

namespace daylit {

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
    LitClusters lit_clusters_;
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
