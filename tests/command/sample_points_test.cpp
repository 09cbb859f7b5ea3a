#include "demo/sample_points.h"

#include <gtest/gtest.h>

namespace daylit {
namespace {

TEST(SamplePoints, LieBesideTheGlassOfASheetNotOnIt) {
    Primitive sheet;
    sheet.indices = {0, 1, 2, 0, 2, 3};
    sheet.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    sheet.normals.assign(4, Vec3(0, 1, 0));
    sheet.uvs = {{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}};
    Scene scene;
    scene.meshes.push_back({"sheet", {sheet}, {}});
    scene.nodes.emplace_back().mesh = 0;
    scene.order = {0};
    scene.images.push_back({2, 1, {255, 0, 0, 255, 0, 0, 0, 255}});
    scene.textures.push_back({.image = 0, .filter = Filter::Nearest});
    scene.materials.emplace_back().transmission = 1.0f;
    scene.materials[0].transmission_texture.texture = 0;
    const Pose pose = pose_scene(scene);
    const WorldMesh mesh = world_mesh(scene, pose, Part::All);
    for (const SurfaceSample& point : sample_surface(RayScene(scene, mesh), pose, 100, 1))
        EXPECT_GT(point.position.x, 0.0f);
}

}  // namespace
}  // namespace daylit
