#pragma once
// Scenes of a few quads, made in memory, and pictures of them.
#include <glm/gtc/matrix_transform.hpp>

#include "engine/gl/context.h"
#include "engine/render/renderer.h"

namespace daylit::render_tests {

inline Material lambert(const Rgb& albedo) {
    Material material;
    material.base_color = Rgba(albedo, 1.0f);
    material.metallic = 0.0f;
    material.specular = 0.0f;  // no coat: the diffuse albedo is the base colour
    return material;
}

/// Four corners in counter-clockwise order seen from the side that the normal points to.
inline Primitive quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int material) {
    Primitive p;
    p.material = material;
    p.indices = {0, 1, 2, 0, 2, 3};
    p.positions = {a, b, c, d};
    p.normals.assign(4, glm::normalize(glm::cross(b - a, c - a)));
    p.uvs = {{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}};
    return p;
}

/// Facing +Y, half sides hx and hz around a centre.
inline Primitive ground(const Vec3& center, float hx, float hz, int material) {
    return quad(center + Vec3(-hx, 0, hz), center + Vec3(hx, 0, hz), center + Vec3(hx, 0, -hz),
                center + Vec3(-hx, 0, -hz), material);
}

/// One node and one mesh a primitive.
inline Scene scene_of(std::vector<Primitive> primitives, std::vector<Material> materials) {
    Scene scene;
    scene.path = "small scene";
    scene.materials = std::move(materials);
    for (Primitive& primitive : primitives) {
        Node node;
        node.name = "node" + std::to_string(scene.nodes.size());
        node.mesh = int(scene.meshes.size());
        scene.order.push_back(int(scene.nodes.size()));
        scene.nodes.push_back(node);
        scene.meshes.push_back({"mesh", {std::move(primitive)}, {}});
    }
    return scene;
}

/// A point lamp of 300 cd in all directions.
inline PunctualLight& add_lamp(Scene& scene, const Vec3& position) {
    PunctualLight lamp;
    lamp.node = int(scene.nodes.size());
    lamp.intensity = Rgb(300.0f);
    Node node;
    node.translation = position;
    node.light = int(scene.lights.size());
    scene.order.push_back(lamp.node);
    scene.nodes.push_back(node);
    return scene.lights.emplace_back(lamp);
}

/// Looks straight down on a square of the ground, x to the right and -z upwards.
inline View from_above(float side, const Vec3& center = Vec3(0.0f), float height = 2.0f) {
    View view = look_at(center + Vec3(0, height, 0.0f), center, 1.0f);
    view.view_from_world = glm::lookAt(view.eye, center, Vec3(0, 0, -1));
    view.orthographic = true;
    view.height = side;
    return view;
}

inline Lighting one_sun(const Vec3& direction, float lux) {
    return {{{glm::normalize(direction), Rgb(lux)}}, {Image(1, 1)}};
}

inline FrameSettings frame_of(const View& view, int width, int height, Layer layer = Layer::Direct) {
    FrameSettings frame;
    frame.view = view;
    frame.width = width;
    frame.height = height;
    frame.show = layer;
    frame.ev = 10.0;
    return frame;
}

inline const PassReport& pass(const FrameReport& report, const std::string& name) {
    for (const PassReport& p : report.passes)
        if (p.name == name) return p;
    throw std::logic_error("no pass " + name);
}

}  // namespace daylit::render_tests
