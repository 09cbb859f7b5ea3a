// Meshes: topologies, attributes in all their forms, what is made where it is missing.
#include <gtest/gtest.h>

#include <set>

#include "engine/base/error.h"
#include "engine/scene/gltf.h"
#include "engine/scene/pose.h"
#include "engine/scene/tangents.h"
#include "tests/support/gltf_builder.h"

namespace daylit {
namespace {

using test::GltfBuilder;

Scene loaded_glb(const GltfBuilder& builder, const LoadOptions& options = {}) {
    const test::TemporaryFolder folder;
    return load_scene(builder.save_glb(folder / "scene.glb"), options);
}

Primitive only_primitive(const GltfBuilder& builder) {
    const Scene scene = loaded_glb(builder);
    EXPECT_EQ(scene.meshes.size(), 1u);
    return scene.meshes.at(0).primitives.at(0);
}

/// Five points of a zigzag in the xy plane; a strip of three triangles that all face +z.
const std::vector<float> kZigzag = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};

Primitive zigzag(int mode) {
    GltfBuilder builder;
    const int positions = builder.floats("VEC3", kZigzag);
    builder.place_primitive({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    return only_primitive(builder);
}

TEST(GltfGeometry, strips_keep_their_facing) {
    const Primitive strip = zigzag(5);
    EXPECT_EQ(strip.indices.size(), 9u);
    for (const Vec3& normal : strip.normals) EXPECT_EQ(normal, Vec3(0, 0, 1));
}

TEST(GltfGeometry, fans_share_their_first_vertex) {
    const Primitive fan = zigzag(6);
    ASSERT_EQ(fan.indices.size(), 9u);
    for (std::size_t t = 0; t < 3; ++t) EXPECT_EQ(fan.positions[fan.indices[3 * t]], Vec3(0.0f));
}

TEST(GltfGeometry, a_triangle_list_drops_what_is_left_over_with_a_note) {
    GltfBuilder builder;
    const int positions = builder.floats("VEC3", kZigzag);
    builder.place_primitive({{"attributes", {{"POSITION", positions}}}});
    const Scene scene = loaded_glb(builder);
    EXPECT_EQ(scene.meshes[0].primitives[0].indices.size(), 3u);
    EXPECT_EQ(scene.notes.size(), 1u);
}

TEST(GltfGeometry, points_stay_points_and_lines_go) {
    const Primitive points = zigzag(0);
    EXPECT_EQ(points.topology, Topology::Points);
    EXPECT_EQ(points.indices.size(), 5u);
    EXPECT_EQ(points.normals.size(), points.positions.size());
    for (const int mode : {1, 2, 3}) {
        GltfBuilder builder;
        const int positions = builder.floats("VEC3", kZigzag);
        builder.place_primitive({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
        const Scene scene = loaded_glb(builder);
        EXPECT_TRUE(scene.meshes[0].primitives.empty());
        ASSERT_EQ(scene.notes.size(), 1u);
        EXPECT_NE(scene.notes[0].find("lines"), std::string::npos);
    }
}

TEST(GltfGeometry, shared_vertices_are_split_for_flat_normals_and_only_then) {
    for (const bool with_normals : {false, true}) {
        GltfBuilder builder;
        // A roof: two triangles over one edge.
        const int positions = builder.floats("VEC3", {0, 0, 0, 0, 0, 1, 1, 1, 0, -1, 1, 0});
        const int indices = builder.indices({0, 1, 2, 0, 3, 1});
        test::Json attributes = {{"POSITION", positions}};
        if (with_normals) attributes["NORMAL"] = builder.floats("VEC3", {0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0});
        builder.place_primitive({{"attributes", attributes}, {"indices", indices}});
        const Primitive roof = only_primitive(builder);
        EXPECT_EQ(roof.positions.size(), with_normals ? 4u : 6u);
        if (with_normals) {
            for (const Vec3& normal : roof.normals) EXPECT_EQ(normal, Vec3(0, 1, 0));
        } else {
            EXPECT_NEAR(glm::dot(roof.normals[0], roof.normals[3]), 0.0f, 1e-6f);
        }
    }
}

TEST(GltfGeometry, vertices_of_no_use_are_left_out) {
    GltfBuilder builder;
    const int positions = builder.floats("VEC3", {9, 9, 9, 0, 0, 0, 1, 0, 0, 8, 8, 8, 0, 1, 0});
    const int normals = builder.floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    const int indices = builder.indices({1, 2, 4});
    builder.place_primitive({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}, {"indices", indices}});
    const Primitive primitive = only_primitive(builder);
    EXPECT_EQ(primitive.positions, (std::vector<Vec3>{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
    EXPECT_EQ(primitive.indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(GltfGeometry, normals_of_no_length_come_from_the_triangle) {
    GltfBuilder builder = test::triangle();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        builder.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    const Scene scene = loaded_glb(builder);
    EXPECT_EQ(scene.meshes[0].primitives[0].normals[0], Vec3(0, 0, 1));
    EXPECT_EQ(scene.notes.size(), 1u);
}

TEST(GltfGeometry, sparse_accessors_with_and_without_a_base) {
    for (const bool base : {true, false}) {
        GltfBuilder builder = test::triangle();
        const int indices = builder.view(std::vector<std::uint8_t>{1, 2});
        const int values = builder.view(std::vector<float>{7, 0, 0, 0, 7, 0});
        builder.json["accessors"][0]["sparse"] = {{"count", 2},
                                                  {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                                  {"values", {{"bufferView", values}}}};
        if (!base) builder.json["accessors"][0].erase("bufferView");
        EXPECT_EQ(only_primitive(builder).positions, (std::vector<Vec3>{Vec3(0), Vec3(7, 0, 0), Vec3(0, 7, 0)}));
    }
}

TEST(GltfGeometry, strides_and_offsets) {
    GltfBuilder builder;
    // Positions and uvs interleaved: 20 bytes a vertex.
    builder.view(std::vector<float>{0, 0, 0, 0.1f, 0.2f, 1, 0, 0, 0.3f, 0.4f, 0, 1, 0, 0.5f, 0.6f});
    builder.json["bufferViews"][0]["byteStride"] = 20;
    builder.json["accessors"] = {
        {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
        {{"bufferView", 0}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}}};
    builder.place_primitive({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}});
    const Primitive primitive = only_primitive(builder);
    EXPECT_EQ(primitive.positions[2], Vec3(0, 1, 0));
    EXPECT_EQ(primitive.uvs.at(0)[1], Vec2(0.3f, 0.4f));
}

TEST(GltfGeometry, normalised_integers) {
    GltfBuilder builder = test::triangle();
    auto& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] =
        builder.accessor<std::uint8_t>("VEC4", 5121, {255, 0, 51, 255, 0, 0, 0, 0, 0, 0, 0, 102}, true);
    attributes["TEXCOORD_0"] = builder.accessor<std::uint16_t>("VEC2", 5123, {65535, 0, 0, 65535, 13107, 0}, true);
    const Primitive primitive = only_primitive(builder);
    EXPECT_EQ(primitive.colors[0], Rgba(1, 0, 0.2f, 1));
    EXPECT_NEAR(primitive.colors[2].a, 0.4f, 1e-7f);
    EXPECT_NEAR(primitive.uvs[0][2].x, 0.2f, 1e-7f);
}

TEST(GltfGeometry, quantised_positions_need_their_extension) {
    GltfBuilder builder;
    const int positions = builder.accessor<std::int16_t>("VEC4", 5122, {0, 0, 0, 0, 100, 0, 0, 0, 0, -32768, 0, 0});
    builder.json["accessors"][0]["type"] = "VEC3";
    builder.json["accessors"][0]["count"] = 3;
    builder.json["bufferViews"][0]["byteStride"] = 8;
    builder.place_primitive({{"attributes", {{"POSITION", positions}}}});
    EXPECT_THROW(loaded_glb(builder), Error);
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    EXPECT_EQ(only_primitive(builder).positions[2], Vec3(0, -32768, 0));
    builder.json["accessors"][0]["normalized"] = true;
    EXPECT_EQ(only_primitive(builder).positions[2], Vec3(0, -1, 0));
}

TEST(GltfGeometry, colours_of_three_components_are_opaque) {
    GltfBuilder builder = test::triangle();
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
        builder.floats("VEC3", {0.5f, 0.25f, 0, 2, 0, -1, 0, 0, 0});
    const Primitive primitive = only_primitive(builder);
    EXPECT_EQ(primitive.colors[0], Rgba(0.5f, 0.25f, 0, 1));
    EXPECT_EQ(primitive.colors[1], Rgba(1, 0, 0, 1));
}

TEST(GltfGeometry, a_unit_scales_every_length) {
    GltfBuilder builder = test::triangle();
    builder.json["nodes"][0]["translation"] = {10, 0, 0};
    builder.json["scenes"][0]["extras"]["daylit"]["unit"] = 0.5;
    const auto far_corner = [&](const LoadOptions& options) {
        const Scene scene = loaded_glb(builder, options);
        return bounds(world_mesh(scene, pose_scene(scene), Part::All)).max;
    };
    EXPECT_EQ(far_corner({}), Vec3(5.5f, 0.5f, 0));
    EXPECT_EQ(far_corner({.unit = 2.0}), Vec3(22, 2, 0));
}

/// A quad in the xy plane seen from +z whose picture stands upright: u to the right, v down.
Primitive upright_quad(bool mirrored) {
    Primitive quad;
    quad.positions = {Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0)};
    quad.normals.assign(4, Vec3(0, 0, 1));
    quad.indices = {0, 3, 2, 0, 2, 1};
    quad.uvs = {{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}};
    if (mirrored)
        for (Vec2& uv : quad.uvs[0]) uv.x = 1 - uv.x;
    return quad;
}

TEST(Tangents, follow_growing_u_and_the_bitangent_points_up_the_picture) {
    for (const bool mirrored : {false, true}) {
        Primitive quad = upright_quad(mirrored);
        make_tangents(quad, 0);
        ASSERT_EQ(quad.tangents.size(), 4u);
        for (std::size_t v = 0; v < 4; ++v) {
            const Vec3 t(quad.tangents[v]);
            EXPECT_EQ(t, Vec3(mirrored ? -1 : 1, 0, 0));
            EXPECT_EQ(glm::cross(quad.normals[v], t) * quad.tangents[v].w, Vec3(0, 1, 0));
        }
    }
}

TEST(Tangents, a_mirror_seam_splits_its_vertices) {
    Primitive both = upright_quad(false);
    // A second quad to the right with mirrored u shares the edge x = 1.
    both.positions.insert(both.positions.end(), {Vec3(2, 1, 0), Vec3(2, 0, 0)});
    both.normals.assign(6, Vec3(0, 0, 1));
    both.uvs[0].insert(both.uvs[0].end(), {Vec2(0, 0), Vec2(0, 1)});
    both.indices.insert(both.indices.end(), {1, 2, 5, 1, 5, 4});
    make_tangents(both, 0);
    EXPECT_EQ(both.positions.size(), 8u);
    EXPECT_EQ(both.tangents.size(), 8u);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(both.tangents[both.indices[i]].w, 1.0f);
    for (std::size_t i = 6; i < 12; ++i) EXPECT_EQ(both.tangents[both.indices[i]].w, -1.0f);
}

TEST(Tangents, without_uvs_are_still_square_to_the_normal) {
    Primitive quad = upright_quad(false);
    quad.uvs.clear();
    quad.normals = {Vec3(0, 0, 1), Vec3(0, 0, -1), glm::normalize(Vec3(1, 2, 3)), Vec3(0, 1, 0)};
    make_tangents(quad, 0);
    for (std::size_t v = 0; v < 4; ++v) {
        EXPECT_NEAR(glm::dot(Vec3(quad.tangents[v]), quad.normals[v]), 0.0f, 1e-6f);
        EXPECT_NEAR(glm::length(Vec3(quad.tangents[v])), 1.0f, 1e-6f);
    }
}

/// The helmet's own tangents come from MikkTSpace; ours must agree in handedness everywhere and nearly in direction.
TEST(Tangents, agree_with_those_of_an_exporter) {
    const auto path = std::filesystem::path(DAYLIT_SHARED_DIR) / "scenes/objects/flight-helmet/FlightHelmet.gltf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "NOT RUN: " << path << " is missing";
    std::size_t vertices = 0, same_hand = 0, near = 0;
    for (const Mesh& mesh : load_scene(path).meshes)
        for (const Primitive& given : mesh.primitives) {
            if (given.tangents.empty()) continue;
            Primitive made = given;
            make_tangents(made, 0);
            for (std::size_t i = 0; i < given.indices.size(); ++i) {
                const Vec4 ours = made.tangents[made.indices[i]], theirs = given.tangents[given.indices[i]];
                ++vertices;
                same_hand += ours.w == theirs.w;
                near += glm::dot(Vec3(ours), Vec3(theirs)) > 0.9f;
            }
        }
    ASSERT_GT(vertices, 100000u);
    EXPECT_GT(double(same_hand) / double(vertices), 0.995);
    EXPECT_GT(double(near) / double(vertices), 0.97);
}

}  // namespace
}  // namespace daylit
