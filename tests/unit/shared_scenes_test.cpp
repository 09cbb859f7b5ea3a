// The shared third-party scenes load with the triangle counts and bounds that their README states.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/scene/gltf.h"
#include "engine/scene/scene_facts.h"

namespace daylit {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(DAYLIT_SHARED_DIR) / "scenes";

TEST(SharedScenes, levels_have_their_triangles_and_bounds) {
    if (!std::filesystem::exists(kScenes)) GTEST_SKIP() << "NOT RUN: the folder " << kScenes << " is missing";
    std::ifstream stream(kScenes / "scenes.json");
    const nlohmann::json levels = nlohmann::json::parse(stream);
    EXPECT_GE(levels.size(), 7u);
    for (const auto& level : levels) {
        const std::string file = level["file"];
        const SceneFacts facts = scene_facts(load_scene(kScenes / file));
        EXPECT_EQ(facts.static_triangles, level["triangles"].get<std::size_t>()) << file;
        for (int axis = 0; axis < 3; ++axis) {
            const float size = facts.bounds.max[axis] - facts.bounds.min[axis];
            EXPECT_NEAR(facts.bounds.min[axis], level["min"][std::size_t(axis)].get<float>(), 1e-4f * size + 1e-3f)
                << file;
            EXPECT_NEAR(facts.bounds.max[axis], level["max"][std::size_t(axis)].get<float>(), 1e-4f * size + 1e-3f)
                << file;
        }
    }
}

struct Object {
    const char* file;
    std::size_t triangles, textures, animations;
};

TEST(SharedScenes, objects) {
    if (!std::filesystem::exists(kScenes)) GTEST_SKIP() << "NOT RUN: the folder " << kScenes << " is missing";
    for (const Object& object :
         {Object{"bunny.glb", 5648, 0, 0}, Object{"suzanne.glb", 14842, 0, 0},
          Object{"flight-helmet/FlightHelmet.gltf", 94722, 15, 0}, Object{"fox.glb", 576, 1, 3}}) {
        const Scene scene = load_scene(kScenes / "objects" / object.file);
        const SceneFacts facts = scene_facts(scene);
        EXPECT_EQ(facts.static_triangles + facts.dynamic_triangles, object.triangles) << object.file;
        EXPECT_EQ(scene.textures.size(), object.textures) << object.file;
        EXPECT_EQ(scene.animations.size(), object.animations) << object.file;
    }
}

TEST(SharedScenes, the_fox_walks_and_keeps_its_size) {
    if (!std::filesystem::exists(kScenes)) GTEST_SKIP() << "NOT RUN: the folder " << kScenes << " is missing";
    const Scene fox = load_scene(kScenes / "objects/fox.glb");
    EXPECT_EQ(scene_facts(fox).static_triangles, 0u);
    const WorldMesh rest = world_mesh(fox, pose_scene(fox, 0.0), Part::Dynamic);
    const WorldMesh later = world_mesh(fox, pose_scene(fox, 0.3), Part::Dynamic);
    float moved = 0;
    for (std::size_t v = 0; v < rest.positions.size(); ++v)
        moved = std::max(moved, glm::length(later.positions[v] - rest.positions[v]));
    EXPECT_GT(moved, 5.0f);  // of 155 units
    const Bounds a = bounds(rest), b = bounds(later);
    EXPECT_NEAR(b.max.z - b.min.z, a.max.z - a.min.z, 0.25f * (a.max.z - a.min.z));
}

}  // namespace
}  // namespace daylit
