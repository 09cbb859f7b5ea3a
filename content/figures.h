#pragma once
// People: a brass knight to stand, and a townsman to walk.
#include "content/castle.h"

namespace daylit::content {

/// About 1.25 m tall on a small base; stands on y = 0, faces +Z.
LevelMesh brass_knight(int material);

/// Adds the skinned walker, his walk cycle and his way through arcade and courtyard.
void add_walker(Castle& castle);

}  // namespace daylit::content
