#pragma once
// Which clusters of what stands each lamp may light, so that a surface asks no lamp that it cannot see.
#include <span>
#include <vector>

#include "engine/render/draw_scene.h"
#include "engine/render/lamp_fit.h"

namespace daylit {

class LitClusters {
  public:
    /// Into scene.lamp_bits: what each lamp sees past what stands alone (a door may open); all, for a lamp that moves.
    /// A no-op while neither lamps nor what stands changed.
    /// texels   along the side of the lamps' shadow maps, which say what is lit no more finely than that
    void find(DrawScene& scene, std::span<const LampFit> lamps, int texels);

  private:
    std::vector<LampFit> known_;
    std::uint64_t version_ = 0;
};

}  // namespace daylit
