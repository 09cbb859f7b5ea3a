#pragma once
// What moves, thing by thing: where each looks up the light of the volume.
#include <vector>

#include "engine/baked/volume_mode.h"
#include "engine/render/draw_mesh.h"

namespace daylit {

/// How the triangles of a cluster are lit by the volume.
struct VolumeUse {
    VolumeMode mode = VolumeMode::Vertex;
    std::uint32_t thing = 0;  // whose light, where it is looked up once
    bool operator==(const VolumeUse&) const = default;
};

class VolumeObjects {
  public:
    /// The triangles of a node are one thing; built by node, and each time they have moved.
    void set_mesh(const DrawMesh& mesh);
    /// Chooses a mode for each thing, unless one is asked for.
    void set_light(const VolumeLight& light, VolumeMode asked);

    /// Of a cluster of the mesh; per vertex before set_light().
    VolumeUse use(std::uint32_t cluster) const;
    /// Radiance SH in the middle of a thing whose mode is Object.
    const glsl::VolumeSh& light(std::uint32_t thing) const { return light_[thing]; }

  private:
    std::vector<ThingSize> things_;
    std::vector<std::uint32_t> thing_of_;  // by cluster
    std::vector<VolumeMode> modes_;        // by thing
    std::vector<glsl::VolumeSh> light_;    // by thing
};

}  // namespace daylit
