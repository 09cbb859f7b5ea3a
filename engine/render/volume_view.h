#pragma once
// A look at an irradiance volume itself: its samples as shaded spheres, its cells as lines.
#include "engine/baked/volume_tree.h"
#include "engine/render/draw_scene.h"

namespace daylit {

/// Of each sampled record: centre and radius. Where a wall parts the records of a corner, each sphere stands aside
/// towards its own cells.
std::vector<Vec4> sample_spheres(const VolumeTree& tree);

class VolumeView {
  public:
    explicit VolumeView(const VolumeTree& tree);
    /// Between opaque surfaces, with BakedVolume bound; as irradiance in lux, or (radiance) as a white surface sends.
    DrawCount draw(Programs& programs, bool radiance) const;

  private:
    int cells_, samples_;
    GlBuffer spheres_;
};

}  // namespace daylit
