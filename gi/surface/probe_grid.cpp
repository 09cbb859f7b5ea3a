#include "gi/surface/probe_grid.h"

#include <algorithm>
#include <cmath>
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

/// The box of each dynamic node at each sampled moment of the longest animation.
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

void add_wanted(const std::vector<Bounds>& boxes, ProbeGrid& grid) {
    std::vector<bool> wanted(grid.count(), false);
    for (const Bounds& box : boxes) {
        std::array<int, 3> first, last;
        for (int a = 0; a < 3; ++a) {
            first[std::size_t(a)] = std::clamp(int(std::floor((box.min[a] - grid.origin[a]) / grid.spacing)), 0,
                                               grid.size[std::size_t(a)] - 1);
            last[std::size_t(a)] = std::clamp(int(std::ceil((box.max[a] - grid.origin[a]) / grid.spacing)), 0,
                                              grid.size[std::size_t(a)] - 1);
        }
        for (int z = first[2]; z <= last[2]; ++z)
            for (int y = first[1]; y <= last[1]; ++y)
                for (int x = first[0]; x <= last[0]; ++x)
                    wanted[(std::size_t(z) * std::size_t(grid.size[1]) + std::size_t(y)) * std::size_t(grid.size[0]) +
                           std::size_t(x)] = true;
    }
    for (std::uint32_t i = 0; i < wanted.size(); ++i)
        if (wanted[i]) grid.wanted.push_back(i);
}

}  // namespace

Vec3 ProbeGrid::position(std::size_t probe) const {
    const std::size_t nx = std::size_t(size[0]), ny = std::size_t(size[1]);
    return origin + spacing * Vec3(float(probe % nx), float(probe / nx % ny), float(probe / nx / ny));
}

ProbeGrid make_probe_grid(const Scene& scene, float spacing, std::size_t most_probes) {
    std::vector<Bounds> boxes = swept_boxes(scene);
    if (boxes.empty()) boxes.push_back(bounds(world_mesh(scene, pose_scene(scene), Part::Static)));
    Bounds all;
    for (const Bounds& box : boxes)
        if (!box.empty()) all.add(box.min), all.add(box.max);
    ProbeGrid grid;
    if (all.empty()) return grid;

    const glm::dvec3 extent = all.max - all.min;
    double step = spacing;
    const auto sides = [&] { return glm::floor(extent / step + 0.999) + 1.0; };
    while (sides().x * sides().y * sides().z > double(std::max<std::size_t>(most_probes, 8))) step *= 1.05;
    grid.spacing = float(step);
    for (int a = 0; a < 3; ++a) grid.size[std::size_t(a)] = int(sides()[a]);
    // Centred, so that what is left over lies on both sides.
    for (int a = 0; a < 3; ++a)
        grid.origin[a] =
            float(0.5 * (double(all.min[a]) + double(all.max[a])) - 0.5 * step * (grid.size[std::size_t(a)] - 1));
    add_wanted(boxes, grid);
    return grid;
}

}  // namespace daylit
