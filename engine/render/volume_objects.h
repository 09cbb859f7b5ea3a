#pragma once
// What moves, thing by thing: where each looks up the light of the volume. What is looked up once a thing or at its
// vertices is worked out here and kept in a buffer, so that a frame pays for it only when things or the light have
// moved.
#include <vector>

#include "engine/baked/volume_mode.h"
#include "engine/gl/owners.h"
#include "engine/render/baked_volume.h"
#include "engine/render/culling.h"
#include "engine/render/draw_mesh.h"

namespace daylit {

/// How a batch of the mesh departs from its thing's mode.
struct BatchLook {
    bool through = false;   // drawn in the blended pass: at vertices whatever the mode
    bool metallic = false;  // mostly gloss, which mirrors light from a direction: at pixels unless a mode is asked for
};

class VolumeObjects {
  public:
    /// The triangles of a node are one thing.
    /// looks   of each batch
    void set_mesh(const DrawMesh& mesh, const std::vector<BatchLook>& looks);
    /// The same triangles after some have moved.
    void move(const DrawMesh& mesh);

    /// Chooses a mode for each thing, unless one is asked for, and finds what may be seen and is not lit.
    /// returns   whether renew() would have work to do
    bool plan(const DrawMesh& mesh, const Frustum& frustum, const VolumeTree& tree, VolumeMode asked, bool light_moved);
    /// Lights what plan() found; returns its triangles.
    long renew(const DrawMesh& mesh, BakedVolume& volume);

    /// Irradiance on front and back, lux, of each vertex of the mesh, as Geometry::use_light() takes it.
    GLuint buffer() const { return buffer_.get(); }
    /// Whether a cluster of the mesh is lit at its pixels; not before plan().
    bool at_pixels(std::uint32_t cluster) const { return !modes_.empty() && mode(cluster) == VolumeMode::Pixel; }
    /// Whether one that plan() saw is.
    bool any_at_pixels() const { return any_at_pixels_; }

  private:
    struct Part {  // of a thing: a cluster
        std::uint32_t thing = 0;
        std::uint32_t first = 0, end = 0;  // its vertices
        std::uint64_t moves = 0;           // as the cluster's when it was last looked at
        BatchLook look;
        VolumeMode lit = VolumeMode::Auto;  // how it is lit in the buffer; Auto: it is not
    };
    VolumeMode mode(std::uint32_t cluster) const;
    void measure(const DrawMesh& mesh);

    std::vector<ThingSize> things_;
    std::vector<VolumeMode> modes_;  // by thing; empty: not chosen since they moved
    VolumeMode asked_ = VolumeMode::Auto;
    std::vector<Part> parts_;           // by cluster
    std::vector<std::uint32_t> unlit_;  // clusters that plan() found
    bool any_at_pixels_ = false;
    GlBuffer buffer_;
};

}  // namespace daylit
