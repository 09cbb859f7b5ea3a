#include "gi/surface/swept_boxes.h"

#include <algorithm>
#include <map>

#include "engine/scene/pose.h"

namespace daylit {
namespace {

constexpr float kMargin = 1.0f;  // metres around what is swept: moves by hand, and places between sampled poses
constexpr int kMostPoses = 192;
constexpr double kPosesPerSecond = 4.0;

Bounds grown(const Bounds& b, float by) {
    return {b.min - Vec3(by), b.max + Vec3(by)};
}

}  // namespace

std::vector<Bounds> swept_boxes(const Scene& scene) {
    double duration = 0.0;
    for (const Animation& animation : scene.animations) duration = std::max(duration, double(animation.duration));
    const int poses = std::clamp(int(duration * kPosesPerSecond) + 1, 1, kMostPoses);
    std::vector<Bounds> boxes;
    for (int i = 0; i < poses; ++i) {
        const WorldMesh mesh = world_mesh(scene, pose_scene(scene, duration * i / poses), Part::Dynamic);
        std::map<std::uint32_t, Bounds> of_node;
        for (std::size_t t = 0; t < mesh.triangle_count(); ++t)
            for (std::size_t k = 0; k < 3; ++k) of_node[mesh.nodes[t]].add(mesh.positions[mesh.indices[3 * t + k]]);
        for (const auto& [node, box] : of_node) boxes.push_back(grown(box, kMargin));
    }
    return boxes;
}

}  // namespace daylit
