#pragma once
// Where light is wanted: what cameras and moving things can reach, and open air.
#include <vector>

#include "engine/scene/pose.h"
#include "gi/surface/free_space.h"

namespace daylit {

struct Reachable {
    /// rays   of the static part of the scene; must outlive this
    Reachable(const Scene& scene, const RayScene& rays);

    std::vector<Bounds> regions;  // boxes that moving things sweep
    FreeSpace space;
};

}  // namespace daylit
