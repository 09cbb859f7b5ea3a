#pragma once
// What every pass draws: the geometry that stands and the geometry that moves, their materials, and the programs.
#include <array>
#include <optional>
#include <vector>

#include "engine/render/geometry.h"
#include "engine/render/materials.h"
#include "engine/render/programs.h"
#include "engine/render/volume_objects.h"

namespace daylit {

/// What one pass cost, for the FrameReport.
struct DrawCount {
    int draws = 0;  // GL calls
    long triangles = 0;
    int clusters_drawn = 0, clusters_culled = 0;
    void add(const DrawList& list);
    void add(const DrawCount& other);
};

/// A bit for each lamp that may light something.
using LampBits = std::array<std::uint32_t, 4>;

/// The lights that may reach something.
struct Lights {
    LampBits lamps = {};
    bool suns = true;
    bool volume_at_pixels = false;  // of what moves: else it is told at vertices
    bool operator==(const Lights&) const = default;
};

/// What the frame asks of every surface program. Where no sun or no lamp reaches, programs have no code for them: even
/// code that is skipped costs a software driver much.
struct FrameDefines {
    std::array<std::vector<std::string>, 2> part;  // what stands, what moves
    std::vector<std::string> suns, lamps;
    bool volume = false;  // lights what moves
    /// A material's own, with all that these lights need.
    std::vector<std::string> with(std::vector<std::string> own, std::size_t part_number, const Lights& lights) const;
};

/// Tells a surface program which lamps to evaluate.
void set_lamp_bits(const Program& program, const LampBits& bits);

/// The triangles of what stands, in each cluster first those that some sun may reach, then those in the dark.
struct SunSplit {
    std::vector<std::uint32_t> reached;  // indices of the first kind, by cluster; empty: not known, all may be reached
    GlBuffer indices;
};

/// Binds a texture with its own filters, in place of a material's sampler.
void bind_texture(GLuint unit, GLuint texture);

struct DrawScene {
    explicit DrawScene(const Scene& s) : scene(s) {}

    const Scene& scene;
    Programs programs;
    std::optional<Materials> materials;
    std::optional<Geometry> parts[2];  // what stands, what moves; empty when there is none
    Bounds box;                        // of both
    bool any_veils = false, any_through = false;
    bool cull = true;           // clusters; false draws everything, to judge what culling saves
    std::uint64_t version = 0;  // one more whenever a triangle has moved
    std::uint64_t standing_version = 0;  // as version, of what stands alone
    std::vector<LampBits> lamp_bits;     // by cluster of what stands; empty: every_lamp may light everything
    LampBits every_lamp = {};            // those that shine
    SunSplit sun_split;
    std::vector<bool> seen_clusters;  // of what stands, by number modulo the size: draw_surfaces() leaves out the
                                      // others; empty: not known, all may be seen
    VolumeObjects volume_objects;  // of what moves
    std::vector<Bounds> moved;  // where those were and are that moved from the version before to this one

    const Material& material(const Batch& batch) const { return scene.materials[batch.material]; }

    /// True when something inside the frustum may differ from what it was at `since`.
    bool moved_in(const Frustum& frustum, std::uint64_t since) const;

    /// Depth of everything that blocks light (OPAQUE, MASK and glass), both sides of every face.
    DrawCount draw_casters(const Mat4& clip_from_world, const Frustum& frustum);
    /// The first BLEND casters behind a known layer of veils (bound to unit 7; -1: none): depth and share let through.
    DrawCount draw_veils(const Mat4& clip_from_world, const Frustum& frustum, int known_layer);
    /// Numbers of the clusters of what stands, nearest first, into an unsigned target with depth.
    void draw_clusters(const Mat4& clip_from_world, const Frustum& frustum);
    /// Depth of what the camera sees, faces that turn away culled unless double-sided. clusters: as draw_clusters()
    /// too.
    DrawCount draw_depth(const Mat4& clip_from_world, const Frustum& frustum, bool clusters);
    /// Shaded OPAQUE and MASK surfaces as the camera sees them; `frame_defines` on top of the material's own.
    DrawCount draw_surfaces(const FrameDefines& frame_defines, const Frustum& frustum);

  private:
    enum class CoverageFor { Light, Eye, Clusters, EyeAndClusters };
    DrawCount draw_coverage(const Mat4& clip_from_world, const Frustum& frustum, CoverageFor purpose);
    std::vector<std::pair<Lights, DrawList>> lists_by_lights(const Geometry& geometry, const Batch& batch,
                                                             const Frustum& frustum, DrawCount& count) const;
    void add_visible(const Geometry& geometry, const Batch& batch, const Frustum& frustum, DrawList& list) const;
};

}  // namespace daylit
