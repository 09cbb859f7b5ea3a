// Broken glTF made here, so that these run anywhere: each is refused in one line that names the file and the place.
#include <gtest/gtest.h>

#include <functional>

#include "engine/base/error.h"
#include "engine/scene/gltf.h"
#include "engine/scene/pose.h"
#include "tests/support/gltf_builder.h"

namespace daylit {
namespace {

using test::GltfBuilder;
using test::Json;

class BrokenGltf : public testing::Test {
  protected:
    std::string error_of(const std::filesystem::path& path) {
        try {
            load_scene(path);
            return {};
        } catch (const Error& error) {
            const std::string what = error.what();
            EXPECT_NE(what.find(path.filename().string()), std::string::npos) << what;
            EXPECT_EQ(what.find('\n'), std::string::npos) << what;
            return what;
        }
    }
    std::string error_of(const GltfBuilder& builder) { return error_of(builder.save_gltf(folder_ / "broken.gltf")); }
    void expect_refused(const GltfBuilder& builder, const std::string& word) {
        const std::string what = error_of(builder);
        EXPECT_NE(what.find(word), std::string::npos) << "'" << what << "' does not say '" << word << "'";
    }
    std::string error_of_bytes(const std::vector<std::uint8_t>& bytes) {
        write_file(folder_ / "broken.glb", bytes);
        return error_of(folder_ / "broken.glb");
    }
    test::TemporaryFolder folder_;
};

TEST_F(BrokenGltf, the_triangle_itself_is_sound) {
    EXPECT_EQ(error_of(test::triangle()), "");
    EXPECT_EQ(error_of_bytes(test::triangle().glb()), "");
}

TEST_F(BrokenGltf, absent_empty_and_foreign_files) {
    EXPECT_NE(error_of(folder_ / "absent.glb").find("no such file"), std::string::npos);
    EXPECT_NE(error_of(folder_.path()).find("not a regular file"), std::string::npos);
    EXPECT_NE(error_of_bytes({}).find("empty"), std::string::npos);
    EXPECT_NE(error_of_bytes({'h', 'e', 'l', 'l', 'o'}).find("JSON"), std::string::npos);
    EXPECT_NE(error_of_bytes({'[', ']'}).find("not an object"), std::string::npos);
}

TEST_F(BrokenGltf, a_glb_cut_anywhere) {
    const std::vector<std::uint8_t> whole = test::triangle().glb();
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(error_of_bytes({whole.begin(), whole.begin() + std::ptrdiff_t(length)}), "") << length;
}

TEST_F(BrokenGltf, lengths_that_lie) {
    const std::vector<std::uint8_t> whole = test::triangle().glb();
    for (const std::size_t field : {8u, 12u})  // of the file, of the JSON chunk
        for (const std::uint8_t byte : {0x00, 0x7f, 0xff}) {
            std::vector<std::uint8_t> lying = whole;
            for (std::size_t i = 0; i < 4; ++i) lying[field + i] = byte;
            EXPECT_NE(error_of_bytes(lying), "") << field << " " << int(byte);
        }
}

TEST_F(BrokenGltf, any_single_byte_changed_never_crashes) {
    const std::vector<std::uint8_t> whole = test::triangle().glb();
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const std::uint8_t flip : {0x01, 0x80}) {
            std::vector<std::uint8_t> changed = whole;
            changed[i] ^= flip;
            error_of_bytes(changed);
        }
}

TEST_F(BrokenGltf, accessors_out_of_range) {
    const auto with = [](const std::function<void(Json&)>& change) {
        GltfBuilder builder = test::triangle();
        change(builder.json);
        return builder;
    };
    expect_refused(with([](Json& j) { j["accessors"][0]["count"] = 4; }), "more than bufferView 0 holds");
    expect_refused(with([](Json& j) { j["accessors"][0]["count"] = 0; }), "0 elements");
    expect_refused(with([](Json& j) { j["accessors"][0]["count"] = -1; }), "integer from 0 up");
    expect_refused(with([](Json& j) { j["accessors"][0]["count"] = 0x5555555555555556ull; }), "elements");
    expect_refused(with([](Json& j) { j["accessors"][0]["byteOffset"] = 4; }), "holds");
    expect_refused(with([](Json& j) { j["accessors"][0]["byteOffset"] = 0xfffffffffffffffcull; }), "");
    expect_refused(with([](Json& j) { j["accessors"][0]["bufferView"] = 7; }), "bufferView 7");
    expect_refused(with([](Json& j) { j["accessors"][0]["componentType"] = 5124; }), "component type");
    expect_refused(with([](Json& j) { j["accessors"][0]["type"] = "VEC2"; }), "type");
    expect_refused(with([](Json& j) { j["bufferViews"][0]["byteLength"] = 40; }), "beyond the 36 bytes");
    expect_refused(with([](Json& j) { j["bufferViews"][0]["byteOffset"] = 0xffffffffffffffffull; }), "beyond");
    expect_refused(with([](Json& j) { j["bufferViews"][0]["buffer"] = 1; }), "buffer 1");
    expect_refused(with([](Json& j) { j["bufferViews"][0]["byteStride"] = 8; }), "stride");
    expect_refused(with([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }), "accessor 9");
    expect_refused(with([](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; }), "mode 7");
    expect_refused(with([](Json& j) { j["meshes"][0]["primitives"][0]["material"] = 0; }), "material 0");
}

TEST_F(BrokenGltf, zeros_out_of_nothing_do_not_exhaust_memory) {
    GltfBuilder builder = test::triangle();
    builder.json["accessors"][0].erase("bufferView");
    for (const std::uint64_t count : {std::uint64_t(1) << 31, std::uint64_t(0xffffffff), std::uint64_t(3) << 60}) {
        builder.json["accessors"][0]["count"] = count;
        EXPECT_NE(error_of(builder), "") << count;
    }
}

TEST_F(BrokenGltf, one_mesh_placed_a_million_times) {
    GltfBuilder builder = test::triangle();
    builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    builder.json["accessors"].push_back({{"componentType", 5126}, {"count", 20000000}, {"type", "VEC3"}});
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 1;
    builder.json["nodes"].push_back(builder.json["nodes"][0]);
    builder.json["scenes"][0]["nodes"] = {0, 1};
    EXPECT_NE(error_of(builder), "");
}

TEST_F(BrokenGltf, indices_beyond_the_vertices) {
    GltfBuilder builder = test::triangle();
    builder.json["meshes"][0]["primitives"][0]["indices"] = builder.indices({0, 1, 3});
    expect_refused(builder, "vertex 3 of 3");
}

TEST_F(BrokenGltf, numbers_that_are_none) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfBuilder builder;
        const int positions = builder.floats("VEC3", {0, 0, 0, bad, 0, 0, 0, 1, 0});
        builder.place_primitive({{"attributes", {{"POSITION", positions}}}});
        expect_refused(builder, "NaN or infinity");
    }
}

TEST_F(BrokenGltf, positions_beyond_any_level) {
    GltfBuilder builder;
    const int positions = builder.floats("VEC3", {0, 0, 0, 3e37f, 0, 0, 0, 1, 0});
    builder.place_primitive({{"attributes", {{"POSITION", positions}}}});
    expect_refused(builder, "1e8 m");
    GltfBuilder moved = test::triangle();
    moved.json["nodes"][0]["scale"] = {1e30, 1e30, 1e30};
    moved.json["nodes"].push_back({{"children", {0}}, {"scale", {1e30, 1e30, 1e30}}});
    moved.json["scenes"][0]["nodes"] = {1};
    expect_refused(moved, "1e8 m");
}

TEST_F(BrokenGltf, triangles_without_area_load) {
    GltfBuilder builder;
    const int positions = builder.floats("VEC3", {0, 0, 0, 0, 0, 0, 0, 1, 0});
    builder.place_primitive({{"attributes", {{"POSITION", positions}}}});
    const Scene scene = load_scene(builder.save_gltf(folder_ / "flat.gltf"));
    EXPECT_EQ(scene.meshes[0].primitives[0].normals[0], Vec3(0, 1, 0));
}

TEST_F(BrokenGltf, node_trees_that_are_none) {
    GltfBuilder self = test::triangle();
    self.json["nodes"][0]["children"] = {0};
    expect_refused(self, "");
    EXPECT_NE(error_of(self), "");
    GltfBuilder loop = test::triangle();
    loop.json["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}};
    EXPECT_NE(error_of(loop), "");
    GltfBuilder ring = test::triangle();
    ring.json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
    expect_refused(ring, "descendant");
    GltfBuilder shared = test::triangle();
    shared.json["nodes"] = {{{"mesh", 0}}, {{"children", {0}}}, {{"children", {0}}}};
    shared.json["scenes"][0]["nodes"] = {1, 2};
    expect_refused(shared, "child of two nodes");
}

TEST_F(BrokenGltf, a_tree_a_hundred_thousand_deep_is_no_problem) {
    GltfBuilder builder = test::triangle();
    constexpr int kDepth = 100000;
    for (int i = 1; i < kDepth; ++i) builder.json["nodes"].push_back({{"children", {i - 1}}});
    builder.json["scenes"][0]["nodes"] = {kDepth - 1};
    EXPECT_EQ(error_of(builder), "");
}

TEST_F(BrokenGltf, json_a_million_deep) {
    std::string text =
        R"({"asset":{"version":"2.0"},"extras":)" + std::string(1000000, '[') + std::string(1000000, ']') + "}";
    write_file(folder_ / "deep.gltf", text);
    EXPECT_NE(error_of(folder_ / "deep.gltf").find("deep"), std::string::npos);
}

TEST_F(BrokenGltf, images_absent_empty_or_of_another_kind) {
    GltfBuilder builder = test::triangle();
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", "picture.png"}}};
    expect_refused(builder, "picture.png");
    write_file(folder_ / "picture.png", std::string());
    expect_refused(builder, "picture.png");
    write_file(folder_ / "picture.png", std::string("\x89PNG\r\n\x1a\n and no more"));
    expect_refused(builder, "picture.png");
    write_file(folder_ / "picture.png", std::string("GIF89a, which nobody reads"));
    expect_refused(builder, "known format");
    std::filesystem::remove(folder_ / "picture.png");
    std::filesystem::create_directory(folder_ / "picture.png");
    expect_refused(builder, "picture.png");
}

TEST_F(BrokenGltf, a_png_that_declares_a_gigapixel) {
    // Signature and IHDR of 16384 x 16384 RGBA; check sums do not matter, since the size is judged first.
    const std::vector<std::uint8_t> header = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0,
                                              13,   'I', 'H', 'D', 'R',  0,    0,    0x40, 0, 0, 0,
                                              0x40, 0,   8,   6,   0,    0,    0,    0,    0, 0, 0};
    EXPECT_THROW(read_image8(header, "huge.png"), Error);
}

TEST_F(BrokenGltf, buffers_absent_short_or_elsewhere) {
    GltfBuilder builder = test::triangle();
    const auto bin = folder_ / "data.bin";
    const auto save = [&] {
        Json whole = builder.json;
        whole["buffers"] = {{{"byteLength", 36}, {"uri", "data.bin"}}};
        write_file(folder_ / "outside.gltf", whole.dump());
        return folder_ / "outside.gltf";
    };
    EXPECT_NE(error_of(save()).find("data.bin"), std::string::npos);
    write_file(bin, std::vector<std::uint8_t>(builder.bytes.begin(), builder.bytes.begin() + 20));
    EXPECT_NE(error_of(save()).find("data.bin"), std::string::npos);
    write_file(bin, builder.bytes);
    EXPECT_EQ(error_of(save()), "");
}

TEST_F(BrokenGltf, skins_and_animations_out_of_range) {
    GltfBuilder builder = test::triangle();
    const int joints = builder.accessor<std::uint8_t>("VEC4", 5121, {0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0});
    const int weights = builder.floats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    builder.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = joints;
    builder.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"].push_back(Json::object());
    builder.json["nodes"].push_back(Json::object());
    builder.json["skins"] = {{{"joints", {1, 2}}}};
    expect_refused(builder, "joint 2");
    builder.json["skins"] = {{{"joints", {1, 9}}}};
    expect_refused(builder, "node 9");

    GltfBuilder animated = test::triangle();
    const int times = animated.floats("SCALAR", {0, 1}), places = animated.floats("VEC3", {0, 0, 0, 1, 0, 0, 2, 0, 0});
    animated.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", places}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    expect_refused(animated, "3 elements for 2 times");
    animated.json["animations"][0]["channels"][0]["sampler"] = 1;
    expect_refused(animated, "sampler 1");
}

TEST_F(BrokenGltf, sparse_parts_out_of_range) {
    const auto sparse = [](const std::vector<std::uint16_t>& which, int count) {
        GltfBuilder builder = test::triangle();
        const int indices = builder.view(which), values = builder.view(std::vector<float>{5, 5, 5, 6, 6, 6});
        builder.json["accessors"][0]["sparse"] = {{"count", count},
                                                  {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                                  {"values", {{"bufferView", values}}}};
        return builder;
    };
    EXPECT_EQ(error_of(sparse({0, 2}, 2)), "");
    expect_refused(sparse({0, 3}, 2), "element 3");
    expect_refused(sparse({2, 0}, 2), "ascend");
    expect_refused(sparse({0, 2}, 4), "sparse");
    expect_refused(sparse({0, 1}, 3), "sparse");
}

TEST_F(BrokenGltf, extras_with_nonsense) {
    GltfBuilder builder = test::triangle();
    builder.json["scenes"][0]["extras"]["daylit"] = {{"latitude", 123}};
    expect_refused(builder, "latitude");
    builder.json["scenes"][0]["extras"]["daylit"] = {{"date", "yesterday"}};
    expect_refused(builder, "date");
    builder.json["scenes"][0]["extras"]["daylit"] = {{"unit", 0}};
    expect_refused(builder, "unit");
}

}  // namespace
}  // namespace daylit
