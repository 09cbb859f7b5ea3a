#pragma once
// BLEND and glass surfaces over what lies behind them: triangles sorted from back to front.
#include "engine/render/draw_scene.h"

namespace daylit {

/// Neighbours in the sorted order that one draw call can take.
struct BlendRun {
    int part;
    std::uint32_t batch;
    std::uint32_t first, count;  // in the sorted indices
};
struct BlendOrder {
    std::vector<std::uint32_t> indices;
    std::vector<BlendRun> runs;
};

/// By the distance of triangle centres along `forward` (perspective: from the eye), furthest first.
BlendOrder sort_blended(const DrawScene& scene, const View& view);

class BlendPass {
  public:
    DrawCount draw(DrawScene& scene, const View& view, const FrameDefines& frame_defines);

  private:
    GlBuffer indices_;
};

}  // namespace daylit
