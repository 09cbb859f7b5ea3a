#pragma once
// The scene's own TEXCOORD_1 as the layout of the lightmap.
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/pose.h"
#include "gi/surface/charts.h"

namespace daylit {

/// A rectangle of TEXCOORD_1 that stays as it is, and what lies in it.
struct KeptLayout {
    Vec2 low = Vec2(0.0f), size = Vec2(1.0f);  // of the rectangle, in TEXCOORD_1
    Vec2 metres = Vec2(0.0f);                  // that it spans along u and v: areas as in the world, shapes on average
    std::optional<glm::ivec2> texels;          // that it was laid out for, where the file says so
    /// Islands: triangles that share corners, place and coordinates alike. Their planes mean nothing.
    std::vector<Chart> islands;
};

struct KeptLayouts {
    std::vector<KeptLayout> layouts;
    std::vector<bool> kept;  // per triangle; the others are to be unwrapped
    std::string note;        // in words, for the plan
};

/// One layout for the whole scene where no two meshes cover the same place of it (an atlas), else one for each copy of
/// a mesh. Meshes without TEXCOORD_1, or without area in it, are not kept. mesh   world_mesh(scene, ..., Part::Static)
/// throws Error that names the mesh when its TEXCOORD_1 lies outside 0 to 1 or overlaps itself, and when no mesh has
/// one
KeptLayouts kept_layouts(const Scene& scene, const WorldMesh& mesh);

}  // namespace daylit
