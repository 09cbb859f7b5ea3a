// Poses, world meshes, views, lamps: numbers that can be worked out on paper.
#include "engine/scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"

namespace daylit {
namespace {

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "component " << c;
}

/// One node with one triangle (0,0,0), (1,0,0), (0,1,0) that faces +z.
Scene one_triangle() {
    Primitive primitive;
    primitive.positions = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    primitive.normals.assign(3, Vec3(0, 0, 1));
    primitive.indices = {0, 1, 2};
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back({"", {primitive}, {}});
    scene.nodes.emplace_back();
    scene.nodes[0].mesh = 0;
    scene.order = {0};
    return scene;
}

AnimationChannel channel(AnimationPath path, Interpolation interpolation, std::vector<float> times,
                         std::vector<float> values) {
    return {0, path, interpolation, std::move(times), std::move(values)};
}

Vec3 place_at(const Scene& scene, double seconds) {
    return Vec3(pose_scene(scene, seconds).world_from_node[0][3]);
}

TEST(Pose, linear_and_step_keys) {
    Scene scene = one_triangle();
    scene.animations = {
        {"",
         2.0f,
         {channel(AnimationPath::Translation, Interpolation::Linear, {0, 1, 2}, {0, 0, 0, 4, 0, 0, 4, 8, 0})}}};
    expect_near(place_at(scene, 0.25), Vec3(1, 0, 0));
    expect_near(place_at(scene, 1.5), Vec3(4, 4, 0));
    expect_near(place_at(scene, 2.25), Vec3(1, 0, 0));  // looped
    expect_near(place_at(scene, -0.5), Vec3(4, 4, 0));  // before the beginning
    scene.animations[0].channels[0].interpolation = Interpolation::Step;
    expect_near(place_at(scene, 0.99), Vec3(0));
    expect_near(place_at(scene, 1.01), Vec3(4, 0, 0));
}

TEST(Pose, cubic_splines_are_hermite_with_tangents_per_second) {
    Scene scene = one_triangle();
    // From 0 to 0 in 2 s, leaving with 3 m/s and arriving with 0: at the middle h10 * 2 * 3 = 0.125 * 6.
    scene.animations = {{"",
                         2.0f,
                         {channel(AnimationPath::Translation, Interpolation::CubicSpline, {0, 2},
                                  {0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})}}};
    expect_near(place_at(scene, 1.0), Vec3(0.75f, 0, 0));
}

TEST(Pose, rotations_take_the_short_way_on_the_sphere) {
    Scene scene = one_triangle();
    const float h = std::sqrt(0.5f);
    // 0 and 90 degrees about y, the second with its sign turned.
    scene.animations = {
        {"", 1.0f, {channel(AnimationPath::Rotation, Interpolation::Linear, {0, 1}, {0, 0, 0, 1, 0, -h, 0, -h})}}};
    const Vec3 turned = Vec3(pose_scene(scene, 1.0 / 3.0).world_from_node[0] * Vec4(0, 0, 1, 0));
    expect_near(turned, Vec3(0.5f, 0, std::sqrt(0.75f)));
}

TEST(Pose, moves_carry_children_and_turn_about_the_vertical) {
    Scene scene = one_triangle();
    scene.nodes.emplace_back();
    scene.nodes[0].parent = 1;
    scene.nodes[0].translation = Vec3(1, 0, 0);
    scene.nodes[1].children = {0};
    scene.nodes[1].translation = Vec3(5, 5, 5);
    scene.order = {1, 0};
    const NodeMove move{1, Vec3(10, 0, 0), float(kPi / 2)};
    const Pose pose = pose_scene(scene, 0.0, std::span(&move, 1));
    // Counter-clockwise seen from above turns +x to -z.
    expect_near(Vec3(pose.world_from_node[0][3]), Vec3(10, 0, -1));
}

TEST(Pose, morph_targets_add_up) {
    Scene scene = one_triangle();
    MorphTarget up, aside;
    up.positions.assign(3, Vec3(0, 0, 2));
    aside.positions = {Vec3(0), Vec3(0), Vec3(4, 0, 0)};
    scene.meshes[0].primitives[0].morph_targets = {up, aside};
    scene.meshes[0].morph_weights = {0.5f, 0.0f};
    EXPECT_EQ(world_mesh(scene, pose_scene(scene), Part::All).positions[2], Vec3(0, 1, 1));
    scene.nodes[0].morph_weights = {0.0f, 0.25f};
    EXPECT_EQ(world_mesh(scene, pose_scene(scene), Part::All).positions[2], Vec3(1, 1, 0));
    scene.animations = {{"", 1.0f, {channel(AnimationPath::Weights, Interpolation::Linear, {0, 1}, {0, 0, 1, 1})}}};
    expect_near(world_mesh(scene, pose_scene(scene, 0.5), Part::All).positions[2], Vec3(2, 1, 1));
}

TEST(Pose, skinned_vertices_follow_their_joints_and_not_their_node) {
    Scene scene = one_triangle();
    scene.nodes[0].translation = Vec3(100, 0, 0);
    scene.nodes[0].skin = 0;
    scene.nodes.resize(3);
    scene.nodes[1].translation = Vec3(0, 0, 5);
    scene.nodes[2].translation = Vec3(0, 7, 0);
    scene.order = {0, 1, 2};
    scene.skins = {{{1, 2}, {Mat4(1.0f), Mat4(1.0f)}}};
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.joints = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}};
    primitive.weights = {Vec4(1, 0, 0, 0), Vec4(1, 0, 0, 0), Vec4(0.5f, 0.5f, 0, 0)};
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::All);
    expect_near(mesh.positions[0], Vec3(0, 0, 5));
    expect_near(mesh.positions[1], Vec3(1, 7, 0));
    expect_near(mesh.positions[2], Vec3(0, 4.5f, 2.5f));
}

Vec3 geometric_normal(const WorldMesh& mesh) {
    const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[i]]; };
    return glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

TEST(WorldMesh, normals_stay_square_under_unequal_scales_and_mirrors) {
    Scene scene = one_triangle();
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.positions = {Vec3(0), Vec3(1, 0, -1), Vec3(0, 1, 0)};
    primitive.normals.assign(3, geometric_normal(world_mesh(scene, pose_scene(scene), Part::All)));
    for (const Vec3& scale :
         {Vec3(3, 0.1f, 1), Vec3(-1, 1, 1), Vec3(-2, -1, -1), Vec3(1e-4f, 1e-4f, 1e-4f), Vec3(-1, -1, 2)}) {
        scene.nodes[0].scale = scale;
        const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::All);
        expect_near(mesh.normals[0], geometric_normal(mesh));
    }
}

TEST(WorldMesh, a_mirror_turns_the_tangent_s_handedness) {
    Scene scene = one_triangle();
    scene.meshes[0].primitives[0].tangents.assign(3, Vec4(1, 0, 0, 1));
    scene.nodes[0].scale = Vec3(1, -1, 1);
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::All);
    const Vec3 bitangent = glm::cross(mesh.normals[0], Vec3(mesh.tangents[0])) * mesh.tangents[0].w;
    expect_near(bitangent, Vec3(0, -1, 0));  // the mirrored +y
}

TEST(WorldMesh, a_flat_scale_gives_no_nan) {
    Scene scene = one_triangle();
    scene.nodes[0].scale = Vec3(0.0f);
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::All);
    for (const Vec3& normal : mesh.normals) EXPECT_NEAR(glm::length(normal), 1.0f, 1e-6f);
}

TEST(View, rays_and_projection_are_one_mapping) {
    View view = look_at(Vec3(1, 2, 3), Vec3(-4, 1, 0), 0.8f);
    for (const bool orthographic : {false, true}) {
        view.orthographic = orthographic;
        view.height = 3.0f;
        for (const Vec2& pixel : {Vec2(0.5f, 0.5f), Vec2(320, 10), Vec2(639.5f, 359.5f), Vec2(100, 300)}) {
            const ViewRay ray = view_ray(view, pixel.x, pixel.y, 640, 360);
            const Vec3 point = ray.origin + 7.0f * ray.direction;
            const Vec4 clip = projection(view, 640, 360) * view.view_from_world * Vec4(point, 1);
            EXPECT_NEAR((clip.x / clip.w + 1) * 320, pixel.x, 2e-3f);
            EXPECT_NEAR((1 - clip.y / clip.w) * 180, pixel.y, 2e-3f);
        }
    }
}

TEST(View, depth_is_1_at_the_near_plane_and_falls_towards_0) {
    View view = look_at(Vec3(0), Vec3(0, 0, -1), 1.0f);
    for (const bool orthographic : {false, true}) {
        view.orthographic = orthographic;
        const auto depth = [&](float distance) {
            const Vec4 clip = projection(view, 100, 100) * view.view_from_world * Vec4(0, 0, -distance, 1);
            return clip.z / clip.w;
        };
        EXPECT_NEAR(depth(view.z_near), 1.0f, 1e-6f);
        EXPECT_GT(depth(10.0f), depth(1000.0f));
        EXPECT_GT(depth(50000.0f), 0.0f);
    }
}

TEST(View, the_middle_ray_looks_at_the_target_and_up_is_up) {
    const View view = look_at(Vec3(3, 4, 5), Vec3(0, 1, 2), 1.0f);
    expect_near(view_ray(view, 50, 50, 100, 100).direction, glm::normalize(Vec3(-1)));
    EXPECT_GT(view_ray(view, 50, 0, 100, 100).direction.y, view_ray(view, 50, 99, 100, 100).direction.y);
    const View down = look_at(Vec3(0, 5, 0), Vec3(0), 1.0f);
    expect_near(view_ray(down, 50, 50, 100, 100).direction, Vec3(0, -1, 0));
    EXPECT_LT(view_ray(down, 50, 0, 100, 100).direction.z, 0.0f);  // north at the top
    EXPECT_THROW(look_at(Vec3(1), Vec3(1), 1.0f), Error);
}

TEST(View, an_overview_holds_the_whole_box) {
    Bounds box;
    box.add(Vec3(-10, 0, -20));
    box.add(Vec3(30, 5, 40));
    const View view = overview(box);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                     corner & 4 ? box.max.z : box.min.z);
        const Vec4 clip = projection(view, 100, 100) * view.view_from_world * Vec4(p, 1);
        EXPECT_LE(std::abs(clip.x), clip.w);
        EXPECT_LE(std::abs(clip.y), clip.w);
        EXPECT_LE(clip.z, clip.w);
    }
}

TEST(View, a_camera_node_s_scale_does_not_show) {
    Scene scene = one_triangle();
    scene.cameras.push_back({.name = "eye", .node = 0});
    scene.nodes[0].translation = Vec3(1, 2, 3);
    scene.nodes[0].scale = Vec3(5, 5, 5);
    const View view = camera_view(scene, pose_scene(scene), "eye");
    EXPECT_EQ(view.eye, Vec3(1, 2, 3));
    expect_near(Vec3(view.view_from_world * Vec4(1, 2, 2, 1)), Vec3(0, 0, -1));
}

TEST(PlacedLight, inverse_square_window_and_cone) {
    PlacedLight lamp;
    lamp.intensity = Rgb(100, 50, 0);
    expect_near(facing_irradiance(lamp, Vec3(0, 2, 0)), Rgb(25, 12.5f, 0));
    lamp.range = 4;  // (1 - (2/4)^4) = 15/16
    expect_near(facing_irradiance(lamp, Vec3(0, 2, 0)), Rgb(25, 12.5f, 0) * 0.9375f);
    expect_near(facing_irradiance(lamp, Vec3(0, 4.01f, 0)), Rgb(0));
    lamp.range = 0;
    lamp.kind = LightKind::Spot;
    lamp.direction = Vec3(0, -1, 0);
    lamp.cos_inner = 0.9f;
    lamp.cos_outer = 0.5f;
    expect_near(facing_irradiance(lamp, Vec3(0, 2, 0)), Rgb(25, 12.5f, 0));
    // cos = 0.7 lies halfway: a quarter of the light.
    const Vec3 aside(2 * std::sqrt(0.51f), 2 * 0.7f, 0);
    expect_near(facing_irradiance(lamp, aside), Rgb(6.25f, 3.125f, 0), 1e-3f);
    expect_near(facing_irradiance(lamp, Vec3(2, 0, 0)), Rgb(0));
    EXPECT_EQ(facing_irradiance(lamp, Vec3(0)), Rgb(0));
}

TEST(PlacedLight, shines_along_minus_z_of_its_node) {
    Scene scene = one_triangle();
    scene.lights.emplace_back();
    scene.lights[0].kind = LightKind::Directional;
    scene.lights[0].node = 0;
    scene.nodes[0].rotation = glm::angleAxis(float(-kPi / 2), Vec3(1, 0, 0));
    scene.nodes[0].scale = Vec3(0.01f);
    expect_near(placed_lights(scene, pose_scene(scene))[0].direction, Vec3(0, -1, 0));
}

}  // namespace
}  // namespace daylit
