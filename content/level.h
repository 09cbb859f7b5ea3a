#pragma once
// A level under construction: what the generators fill and glb_writer.h writes. Metres, +Y up, as everywhere.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/units.h"
#include "engine/scene/day.h"
#include "engine/scene/scene.h"

namespace daylit::content {

/// A material. Texture numbers index Level::pictures; -1: none.
struct Surface {
    std::string name;
    Rgb color = Rgb(1.0f);  // linear albedo, multiplies the colour texture
    float alpha = 1.0f;
    float metallic = 0.0f;
    float roughness = 1.0f;
    float specular = 1.0f;       // KHR_materials_specular; 0: a pure Lambert surface
    Rgb emission = Rgb(0.0f);    // cd/m^2
    Lit lit = Lit::Always;       // of emission
    int color_picture = -1;      // sRGB-coded
    int normal_picture = -1;     // tangent space, linear
    int roughness_picture = -1;  // G roughness, B metallic, linear; multiplies the factors
    float normal_scale = 1.0f;
    Vec2 tile = Vec2(1.0f);  // metres a repeat of the pictures; builders write texture coordinates in metres
    AlphaMode alpha_mode = AlphaMode::Opaque;
    bool double_sided = false;
    float transmission = 0.0f;
    float ior = 1.5f;
};

struct Picture {
    std::string name;
    std::vector<std::uint8_t> png;
};

/// Triangles of one material. joints and weights are empty or as long as positions.
struct Geometry {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;  // metres
    std::vector<std::array<std::uint16_t, 4>> joints;
    std::vector<Vec4> weights;
    std::vector<std::uint32_t> indices;
};

struct LevelMesh {
    std::string name;
    std::map<int, Geometry> parts;  // by material
    std::size_t triangle_count() const;
};

struct LevelNode {
    std::string name;
    Vec3 translation = Vec3(0.0f);
    Quat rotation = Quat(1, 0, 0, 0);
    Vec3 scale = Vec3(1.0f);
    int mesh = -1, skin = -1, camera = -1, light = -1;
    std::vector<int> children;
    bool dynamic = false;  // written as extras.daylit.dynamic; animated nodes need no mark
};

struct LevelCamera {
    double vertical_fov_deg = 60.0;
    double z_near = 0.05;
};

/// A point light, or a spot when outer_cone > 0 (radians).
struct Lamp {
    std::string name;
    Rgb intensity = Rgb(1.0f);  // cd
    Lit lit = Lit::Always;
    float inner_cone = 0.0f, outer_cone = 0.0f;
};

struct LevelSkin {
    std::string name;
    std::vector<int> joints;            // nodes
    std::vector<Mat4> joint_from_mesh;  // inverse bind matrices
};

struct LevelChannel {
    int node = -1;
    AnimationPath path = AnimationPath::Translation;
    std::vector<float> times;
    std::vector<Vec4> values;  // xyz, or a quaternion as xyzw
};

struct LevelAnimation {
    std::string name;
    std::vector<LevelChannel> channels;
};

struct Level {
    std::string name;
    std::vector<Surface> surfaces;
    std::vector<Picture> pictures;
    std::vector<LevelMesh> meshes;
    std::vector<LevelNode> nodes;
    std::vector<int> roots;
    std::vector<LevelCamera> cameras;
    std::vector<Lamp> lamps;
    std::vector<LevelSkin> skins;
    std::vector<LevelAnimation> animations;
    std::optional<Day> day;  // written as scene.extras.daylit

    int add_surface(Surface surface);
    int add_mesh(LevelMesh mesh);
    /// parent -1: a root.
    int add_node(LevelNode node, int parent = -1);
    /// A node with this mesh at the origin.
    int add_object(LevelMesh mesh);
    /// A camera node called `name` at `eye`, looking at `at`, level with the horizon.
    int add_camera(const std::string& name, const Vec3& eye, const Vec3& at, double vertical_fov_deg);
    int add_lamp(const Lamp& lamp, const Vec3& position, int parent = -1);
    std::size_t triangle_count() const;  // meshes counted once for every node that shows them
};

/// Rotation that takes -Z to the direction from eye to at, with +X level.
Quat looking(const Vec3& eye, const Vec3& at);

}  // namespace daylit::content
