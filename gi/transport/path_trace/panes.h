#pragma once
// Which glass triangles are thin panes, and which bound a solid body.
#include <vector>

#include "engine/scene/pose.h"
#include "gi/transport/path_trace/materials.h"

namespace daylit {

/// One flag per triangle: true for glass whose surface is open (some edge has no partner, by position). Such a sheet
/// stands for a pane of no thickness; refracting at it would bend the light into a body that has no other side.
/// Empty when the mesh has no glass.
std::vector<bool> find_panes(const WorldMesh& mesh, const Materials& materials);

}  // namespace daylit
