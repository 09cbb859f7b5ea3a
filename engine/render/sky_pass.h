#pragma once
// The sky's map behind everything, with the suns' discs in it.
#include "engine/render/draw_scene.h"
#include "engine/scene/sky.h"

namespace daylit {

class SkyPass {
  public:
    /// Uploads the map when it is another one than before.
    void set_environment(const Environment& sky);
    bool black() const { return black_; }
    /// Where depth is still at the far plane.
    DrawCount draw(Programs& programs, std::size_t suns) const;

  private:
    Image map_;  // what the texture holds
    bool black_ = true;
    GlTexture texture_;
};

}  // namespace daylit
