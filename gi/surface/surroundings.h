#pragma once
// How near the surroundings of each triangle are: what decides how fast light can vary there.
#include <vector>

#include "gi/trace/ray_scene.h"

namespace daylit {

/// What a triangle's front sees, over its points and the cosine-weighted hemisphere at each; of its back where the
/// front is covered. Nearness at a point is the mean of 1 / distance, per metre; sky has none.
struct Surroundings {
    float nearness = 0.0f;     // mean over the points
    Mat3 change = Mat3(0.0f);  // mean of g g^T / |g|, per square metre: g is the gradient of nearness along the surface
    bool hidden = false;       // every point lies inside solid geometry or right under another surface
};

/// Per triangle of rays.mesh(). Same result for any number of threads.
/// spacing   metres between points; nothing counts as nearer than that, and what lies within a hundredth of it covers
std::vector<Surroundings> look_around(const RayScene& rays, float spacing);

}  // namespace daylit
