// Every glTF file of the shared hostile sets has the outcome that its class asks for, and none crashes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "engine/base/error.h"
#include "engine/scene/gltf.h"
#include "engine/scene/pose.h"
#include "tests/hostile/index_file.h"

namespace daylit {
namespace {

struct Outcome {
    std::string error;  // empty: it loaded
    bool noted = false;
};

void expect_sound(const Scene& scene, const std::string& name) {
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene, 0.25), Part::All);
    const auto finite = [](const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    EXPECT_TRUE(std::all_of(mesh.positions.begin(), mesh.positions.end(), finite)) << name;
    for (const Vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1.0f, 1e-3f) << name;
    for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.positions.size()) << name;
}

Outcome outcome(const std::filesystem::path& path) {
    try {
        const Scene scene = load_scene(path);
        expect_sound(scene, path.string());
        return {"", !scene.notes.empty()};
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
        return {error.what(), false};
    }
}

/// Valid files that tinygltf 2.7 cannot read: an unknown accessor type, buffers without a uri or with a URI that is
/// not base64, and an integer written with a point.
bool beyond_tinygltf(const std::string& file) {
    static const std::vector<std::string> kFiles = {
        "base/accessor/unknown_type.gltf", "base/accessor/valid.gltf", "base/buffer/data_uri.glb",
        "base/json/integer_written_as_float.gltf", "base/root/named_objects.gltf"};
    return std::find(kFiles.begin(), kFiles.end(), file) != kFiles.end();
}

class HostileGltf : public testing::TestWithParam<const char*> {};

TEST_P(HostileGltf, has_the_outcome_of_its_class) {
    const std::filesystem::path folder = std::filesystem::path(DAYLIT_SHARED_DIR) / "hostile" / GetParam();
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "NOT RUN: the folder " << folder << " is missing";
    std::size_t checked = 0;
    for (const auto& row : test::read_index(folder / "index.csv")) {
        const std::string file = row.at("file"), kind = row.at("class");
        const std::string extension = std::filesystem::path(file).extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        const Outcome result = outcome(folder / file);
        const bool by_name = result.error.find("is required by the file and not supported") != std::string::npos;
        if (kind == "ok") {
            EXPECT_TRUE(result.error.empty() || by_name || beyond_tinygltf(file)) << file << ": " << result.error;
        } else if (kind == "unsafe") {
            EXPECT_TRUE(!result.error.empty() || result.noted) << file << " loads without a word";
        }
        ++checked;
    }
    EXPECT_GT(checked, 0u);
}

INSTANTIATE_TEST_SUITE_P(sets, HostileGltf,
                         testing::Values("khronos-validator", "assimp", "tinygltf", "cgltf", "meshoptimizer",
                                         "draco-required"),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(HostileGltf, a_required_extension_is_refused_by_name) {
    const auto path = std::filesystem::path(DAYLIT_SHARED_DIR) / "hostile/draco-required/bunny-draco.glb";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "NOT RUN: " << path << " is missing";
    EXPECT_NE(outcome(path).error.find("KHR_draco_mesh_compression"), std::string::npos);
}

TEST(HostileGltf, gltf_1_is_refused_with_its_version) {
    const auto path =
        std::filesystem::path(DAYLIT_SHARED_DIR) / "hostile/assimp/gltf-1.0/IncorrectVertexArrays/Cube_v1.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "NOT RUN: " << path << " is missing";
    EXPECT_NE(outcome(path).error.find("version"), std::string::npos) << outcome(path).error;
}

/// Counts by hand from the asset generator's tables: lines give nothing, points are points, the rest two triangles.
TEST(HostileGltf, primitive_modes_hold_what_they_should) {
    const auto folder =
        std::filesystem::path(DAYLIT_SHARED_DIR) / "hostile/assimp/glTF-Asset-Generator/Mesh_PrimitiveMode";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "NOT RUN: the folder " << folder << " is missing";
    const std::map<std::string, std::size_t> triangles = {{"04", 2}, {"05", 2}, {"06", 2},
                                                          {"11", 2}, {"12", 2}, {"13", 2}};
    for (const auto& [number, count] : triangles) {
        const Scene scene = load_scene(folder / ("Mesh_PrimitiveMode_" + number + ".gltf"));
        EXPECT_EQ(world_mesh(scene, pose_scene(scene), Part::All).triangle_count(), count) << number;
    }
}

}  // namespace
}  // namespace daylit
