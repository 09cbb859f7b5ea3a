#include "gi/surface/reachable.h"

#include "gi/surface/swept_boxes.h"

namespace daylit {
namespace {

constexpr int kSpaceCells = 128;  // along the scene's longest side

}  // namespace

Reachable::Reachable(const Scene& scene, const RayScene& rays) : regions(swept_boxes(scene)), space(rays, kSpaceCells) {
    const Pose pose = pose_scene(scene);
    for (const Camera& camera : scene.cameras) space.start_at(Vec3(pose.world_from_node[std::size_t(camera.node)][3]));
    for (const Bounds& region : regions) {
        const Vec3 middle = 0.5f * (region.min + region.max);
        if (!region.empty() && !space.buried(middle)) space.start_at(middle);  // a wall's inside is no place to be in
    }
    space.start_under_the_sky();
    space.spread();
}

}  // namespace daylit
