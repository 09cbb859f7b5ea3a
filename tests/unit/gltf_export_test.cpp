// The scene's file written again with a lightmap's layout: nothing else may change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/base/error.h"
#include "engine/scene/gltf.h"
#include "engine/scene/gltf_export.h"
#include "tests/support/gltf_builder.h"

namespace daylit {
namespace {

using test::GltfBuilder;
using test::Json;

/// A sheet of 2 x 2 quads with shared vertices, and a strip beside it.
GltfBuilder level() {
    GltfBuilder b;
    std::vector<float> positions, normals, uvs;
    std::vector<std::uint8_t> colors;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) {
            for (const float v : {float(x), float(y), 0.1f * float(x * y)}) positions.push_back(v);
            for (const float v : {0.0f, 0.0f, 1.0f}) normals.push_back(v);
            for (const float v : {0.3f * float(x), 0.7f * float(y)}) uvs.push_back(v);
            for (const int v : {20 * x, 100, 30 * y, 255}) colors.push_back(std::uint8_t(v));
        }
    std::vector<std::uint16_t> indices;
    for (const int q : {0, 1, 3, 4})
        for (const int corner : {q, q + 1, q + 4, q, q + 4, q + 3}) indices.push_back(std::uint16_t(corner));
    const Json attributes = {{"POSITION", b.floats("VEC3", positions)},
                             {"NORMAL", b.floats("VEC3", normals)},
                             {"TEXCOORD_0", b.floats("VEC2", uvs)},
                             {"COLOR_0", b.accessor("VEC4", 5121, colors, true)}};
    const Json strip = {{"POSITION", b.floats("VEC3", {5, 0, 0, 6, 0, 0, 5, 1, 0, 6, 1, 0})}};
    b.json["materials"] = {{{"name", "grey"}, {"extras", {{"anything", {1, 2, 3}}}}}};
    b.json["meshes"] = {{{"name", "sheet"},
                         {"primitives",
                          {{{"attributes", attributes}, {"indices", b.indices(indices)}, {"material", 0}},
                           {{"attributes", strip}, {"mode", 5}}}}}};
    const Json instancing = {
        {"attributes",
         {{"TRANSLATION", b.floats("VEC3", {0, 10, 0, 0, 20, 0})}, {"SCALE", b.floats("VEC3", {1, 2, 1, -1, 1, 1})}}}};
    b.json["nodes"] = {{{"mesh", 0}, {"name", "first"}, {"extras", {{"mine", true}}}},
                       {{"mesh", 0}, {"scale", {-1, 1, 1}}, {"translation", {-3, 0, 0}}},
                       {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", instancing}}}},
                       {{"mesh", 0}, {"translation", {0, 0, 9}}, {"name", "moves"}}};
    b.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing", "VENDOR_unknown"};
    b.json["extensions"] = {{"VENDOR_unknown", {{"kept", "yes"}}}};
    b.json["animations"] = {
        {{"samplers", {{{"input", b.floats("SCALAR", {0, 1})}, {"output", b.floats("VEC3", {0, 0, 9, 1, 0, 9})}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 3}, {"path", "translation"}}}}}}}};
    b.json["scenes"] = {{{"nodes", {0, 1, 2, 3}}, {"extras", {{"daylit", {{"turbidity", 3.5}}}}}}};
    b.json["scene"] = 0;
    return b;
}

/// All numbers of a triangle's corners, rounded; sorted, since instances become nodes at the end.
std::vector<std::vector<long>> numbers(const WorldMesh& mesh, const std::vector<Vec2>& second) {
    std::vector<std::vector<long>> result(mesh.triangle_count());
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const std::uint32_t v = mesh.indices[corner];
        const Vec3 &p = mesh.positions[v], &n = mesh.normals[v];
        const Rgba& c = mesh.colors[v];
        const Vec2 &a = mesh.uvs[v][0], &b = second.empty() ? mesh.uvs[v][1] : second[corner];
        for (const float x : {p.x, p.y, p.z, n.x, n.y, n.z, c.x, c.y, c.z, a.x, a.y, b.x, b.y})
            result[corner / 3].push_back(std::lround(1e4f * x));
    }
    std::sort(result.begin(), result.end());
    return result;
}

/// A layout with seams between all quads.
std::vector<Vec2> layout_for(const WorldMesh& mesh) {
    std::vector<Vec2> uvs;
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner)
        uvs.emplace_back(float(corner / 6) / float(mesh.indices.size() / 6 + 1), float(corner % 6) / 6.0f);
    return uvs;
}

Json json_of(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = read_file(path);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    return Json::parse(bytes.begin() + 20, bytes.begin() + 20 + length);
}

TEST(GltfExport, AddsTheLayoutAndChangesNothingElse) {
    const test::TemporaryFolder folder;
    const GltfBuilder before = level();
    for (const auto& path : {before.save_glb(folder / "a.glb"), before.save_gltf(folder / "b.gltf")}) {
        const Scene scene = load_scene(path);
        const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::Static);
        ASSERT_EQ(mesh.triangle_count(), 4u * 10u);
        const std::vector<Vec2> layout = layout_for(mesh);
        export_glb(scene, mesh, layout, {640, 320}, folder / "out.glb");

        const Scene again = load_scene(folder / "out.glb");
        const WorldMesh exported = world_mesh(again, pose_scene(again), Part::Static);
        EXPECT_EQ(numbers(exported, {}), numbers(mesh, layout));
        EXPECT_EQ(numbers(world_mesh(again, pose_scene(again, 0.5), Part::Dynamic), {}),
                  numbers(world_mesh(scene, pose_scene(scene, 0.5), Part::Dynamic), {}));
        ASSERT_TRUE(again.extras.lightmap);
        EXPECT_EQ(*again.extras.lightmap, glm::ivec2(640, 320));
        EXPECT_EQ(again.extras.turbidity, 3.5);

        const Json after = json_of(folder / "out.glb");
        for (const char* part : {"asset", "materials", "animations", "extensions", "extensionsUsed", "scene"})
            EXPECT_EQ(after[part], before.json[part]) << part;
        EXPECT_EQ(after["nodes"][0]["extras"], before.json["nodes"][0]["extras"]);
        EXPECT_EQ(after["nodes"][3], before.json["nodes"][3]);
        EXPECT_EQ(after["buffers"].size(), 1u);
        EXPECT_FALSE(after["buffers"][0].contains("uri"));
    }
}

TEST(GltfExport, ATextureThatNeedsTheSecondSetIsNamed) {
    const test::TemporaryFolder folder;
    GltfBuilder b = level();
    b.json["materials"][0]["extensions"]["VENDOR_unknown"]["dirt"] = {{"index", 0}, {"texCoord", 1}};
    const Scene scene = load_scene(b.save_glb(folder / "a.glb"));
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::Static);
    try {
        export_glb(scene, mesh, layout_for(mesh), {8, 8}, folder / "out.glb");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("material 0 'grey' draws a texture by TEXCOORD_1"), std::string::npos)
            << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "out.glb"));
}

}  // namespace
}  // namespace daylit
