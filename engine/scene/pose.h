#pragma once
// Where everything is at one moment: animation, moves, skins and morph targets applied.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

namespace daylit {

/// --move NODE=x,y,z[,yaw]: puts the node's origin at a place in the world; yaw (radians, counter-clockwise seen from
/// above) turns it about the world's vertical through its own origin, on top of the file's rotation.
struct NodeMove {
    int node = -1;
    Vec3 position = Vec3(0.0f);
    float yaw = 0.0f;
};

struct Pose {
    std::vector<Mat4> world_from_node;  // one per Scene::nodes; identity for nodes outside the default scene
    std::vector<std::vector<float>> morph_weights;  // one per node; empty when its mesh has no morph targets
};

/// The pose at `seconds` on every animation's own looped clock, then the moves.
Pose pose_scene(const Scene& scene, double seconds = 0.0, std::span<const NodeMove> moves = {});

/// Skinning matrices of a node with a skin, world_from_mesh per joint (glTF: the node's own transform is ignored).
std::vector<Mat4> skin_matrices(const Scene& scene, const Pose& pose, int node);

enum class Part : std::uint8_t { Static, Dynamic, All };

/// Triangles in world space, deindexed attributes shared where the file shared them; for tracing, baking and upload.
/// Order: nodes in Scene::order, then instances, primitives, triangles; the same file gives the same order.
/// Triangles of zero area and those with vertices that coincide are kept (the tracer and unwrapper skip them), so that
/// counts agree with the file.
struct WorldMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;             // unit
    std::vector<Vec4> tangents;            // xyz unit and handedness; zero where the primitive has none
    std::vector<std::array<Vec2, 2>> uvs;  // TEXCOORD_0 and _1 (zero when absent)
    std::vector<Rgba> colors;              // white when absent
    std::vector<std::uint32_t> indices;    // 3 per triangle
    std::vector<std::uint32_t> materials;  // one per triangle
    std::vector<std::uint32_t> nodes;      // one per triangle
    std::size_t triangle_count() const { return materials.size(); }
};

/// A mirrored node (negative determinant) has its triangles' winding flipped, so that geometric normals stay outward.
WorldMesh world_mesh(const Scene& scene, const Pose& pose, Part part);

/// Where one copy of a mesh lies in world_mesh(scene, ..., part): its primitives of triangles, one after the other.
struct PlacedMesh {
    int node = -1;
    std::size_t instance = 0;  // of the node
    std::size_t first_triangle = 0, triangles = 0;
};
std::vector<PlacedMesh> placed_meshes(const Scene& scene, Part part);

struct Bounds {
    Vec3 min = Vec3(1e30f), max = Vec3(-1e30f);
    bool empty() const { return min.x > max.x; }
    void add(const Vec3& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
};
Bounds bounds(const WorldMesh& mesh);

/// A punctual light in the world.
struct PlacedLight {
    LightKind kind = LightKind::Point;
    Vec3 position = Vec3(0.0f);
    Vec3 direction = Vec3(0, 0, -1);  // the way it shines, unit
    Rgb intensity = Rgb(0.0f);        // cd, or lux for directional; when it is lit
    Lit lit = Lit::Always;
    float range = 0.0f;  // 0: infinite
    float cos_inner = 1.0f, cos_outer = 0.0f;
    int node = -1;
};
std::vector<PlacedLight> placed_lights(const Scene& scene, const Pose& pose);

/// Irradiance at distance vector `to_light` (from the point to the light) on a plane facing the light, in lux:
/// I * window(range) * spot / d^2; zero outside the cone. Point and spot only.
Rgb facing_irradiance(const PlacedLight& light, const Vec3& to_light);

struct View {
    Vec3 eye = Vec3(0.0f);
    Mat4 view_from_world = Mat4(1.0f);
    float vertical_fov = 1.0f;  // radians
    bool orthographic = false;
    float height = 2.0f;  // metres, orthographic
    float z_near = 0.05f;
};

/// The camera with this name; the error lists the names there are.
View camera_view(const Scene& scene, const Pose& pose, const std::string& name);
View look_at(const Vec3& eye, const Vec3& at, float vertical_fov);
/// The whole scene seen from outside and a little above, for scenes without a camera.
View overview(const Bounds& bounds);

/// Primary ray through the continuous pixel position (x right, y down, in pixels) of a width x height picture;
/// the same mapping as the rasteriser's projection.
struct ViewRay {
    Vec3 origin, direction;
};
ViewRay view_ray(const View& view, float x, float y, int width, int height);
/// The same for many rays of one picture.
class ViewRays {
  public:
    ViewRays(const View& view, int width, int height);
    ViewRay at(float x, float y) const;

  private:
    Mat3 world_from_view_;
    Vec3 eye_;
    bool orthographic_;
    float width_, height_;
    Vec2 half_;  // of the picture: metres where orthographic, else at a metre's distance
};
/// clip_from_view with an infinite far plane and reversed depth (1 near, 0 far), for GL_ZERO_TO_ONE clip control.
Mat4 projection(const View& view, int width, int height);

}  // namespace daylit
