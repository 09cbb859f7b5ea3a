#include "content/level.h"

#include <utility>

namespace daylit::content {

std::size_t LevelMesh::triangle_count() const {
    std::size_t count = 0;
    for (const auto& [material, geometry] : parts) count += geometry.indices.size() / 3;
    return count;
}

int Level::add_surface(Surface surface) {
    surfaces.push_back(std::move(surface));
    return int(surfaces.size()) - 1;
}

int Level::add_mesh(LevelMesh mesh) {
    meshes.push_back(std::move(mesh));
    return int(meshes.size()) - 1;
}

int Level::add_node(LevelNode node, int parent) {
    const int index = int(nodes.size());
    nodes.push_back(std::move(node));
    (parent < 0 ? roots : nodes[std::size_t(parent)].children).push_back(index);
    return index;
}

int Level::add_object(LevelMesh mesh) {
    LevelNode node;
    node.name = mesh.name;
    node.mesh = add_mesh(std::move(mesh));
    return add_node(std::move(node));
}

int Level::add_camera(const std::string& camera_name, const Vec3& eye, const Vec3& at, double vertical_fov_deg) {
    LevelNode node;
    node.name = camera_name;
    node.translation = eye;
    node.rotation = looking(eye, at);
    node.camera = int(cameras.size());
    cameras.push_back({vertical_fov_deg});
    return add_node(std::move(node));
}

int Level::add_lamp(const Lamp& lamp, const Vec3& position, int parent) {
    LevelNode node;
    node.name = lamp.name;
    node.translation = position;
    if (lamp.outer_cone > 0.0f) node.rotation = glm::angleAxis(-float(kPi) / 2, Vec3(1, 0, 0));  // shines down
    node.light = int(lamps.size());
    lamps.push_back(lamp);
    return add_node(std::move(node), parent);
}

std::size_t Level::triangle_count() const {
    std::size_t count = 0;
    for (const LevelNode& node : nodes)
        if (node.mesh >= 0) count += meshes[std::size_t(node.mesh)].triangle_count();
    return count;
}

Quat looking(const Vec3& eye, const Vec3& at) {
    const Vec3 back = glm::normalize(eye - at);
    const Vec3 up = std::abs(back.y) > 0.999f ? Vec3(0, 0, -1) : Vec3(0, 1, 0);
    const Vec3 right = glm::normalize(glm::cross(up, back));
    return glm::normalize(glm::quat_cast(Mat3(right, glm::cross(back, right), back)));
}

}  // namespace daylit::content
