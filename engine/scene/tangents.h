#pragma once
// Tangent frames for normal maps where a file brings none.
#include "engine/scene/scene.h"

namespace daylit {

/// Some unit vector square to a unit normal (Duff et al. 2017, branchless ONB, first axis).
Vec3 any_tangent(const Vec3& normal);

/// Fills primitive.tangents from positions, normals and the uv set: each triangle's direction of growing u, projected
/// on the vertex normal and averaged by corner angle (as MikkTSpace weights it). A vertex whose triangles disagree in
/// handedness (mirrored uvs) is split. Without usable uvs any tangent is taken.
void make_tangents(Primitive& primitive, int uv_set);

}  // namespace daylit
