#pragma once
// The scene's own file again, with the lightmap's layout as TEXCOORD_1, for other engines.
#include <span>

#include "engine/scene/pose.h"

namespace daylit {

/// Writes the file that `scene` was loaded from as one .glb. Static triangles get TEXCOORD_1, their vertices split
/// where the layout has seams; copies of a mesh get meshes of their own, and instances (EXT_mesh_gpu_instancing) nodes.
/// All else stays, buffers and pictures embedded. The scene's extras.daylit.lightmap says for how many texels it is.
/// mesh         world_mesh(scene, ..., Part::Static)
/// corner_uvs   three per triangle of mesh, 0 to 1; v = 0 is the lightmap's row 0
/// throws Error when a material of a static mesh draws a texture by TEXCOORD_1, and when `path` cannot be written
void export_glb(const Scene& scene, const WorldMesh& mesh, std::span<const Vec2> corner_uvs, const glm::ivec2& texels,
                const std::filesystem::path& path);

}  // namespace daylit
