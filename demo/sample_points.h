#pragma once
// Random places to measure light at.
#include <cstdint>
#include <vector>

#include "gi/trace/ray_scene.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

/// Uniform by area over the static surfaces (those of the whole scene when none is static), on the side that their
/// winding faces; not on glass, nor where a material is cut away or clear, nor where solids meet or overlap, so that
/// nobody can see the place: all that it sees is covering surfaces at its very front and backs of others.
std::vector<SurfaceSample> sample_surface(const RayScene& rays, const Pose& pose, int count, std::uint64_t seed);

/// Uniform in the free space that can be reached: a grid of cells over the scene's bounds is flooded from cell to cell
/// wherever nothing stands between their centres, starting at the cameras, or, in a scene without cameras, at the cells
/// under the open sky. A point counts when nothing stands between it and the centre of its flooded cell. Normals are
/// uniform over the sphere.
std::vector<SurfaceSample> sample_space(const RayScene& rays, const Pose& pose, int count, std::uint64_t seed);

}  // namespace daylit
