// Nodes, cameras, lights, materials, images, extras, instances: what a file says arrives, with glTF's defaults.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/scene/gltf.h"
#include "engine/scene/pose.h"
#include "engine/scene/scene_facts.h"
#include "engine/scene/texture.h"
#include "tests/support/gltf_builder.h"

namespace daylit {
namespace {

using test::GltfBuilder;
using test::Json;

Scene loaded_gltf(const GltfBuilder& builder, const LoadOptions& options = {}) {
    const test::TemporaryFolder folder;
    return load_scene(builder.save_gltf(folder / "scene.gltf"), options);
}

bool noted(const Scene& scene, const std::string& word) {
    return std::any_of(scene.notes.begin(), scene.notes.end(),
                       [&](const std::string& note) { return note.find(word) != std::string::npos; });
}

/// The triangle with one material.
GltfBuilder with_material(const Json& material) {
    GltfBuilder builder = test::triangle();
    builder.json["materials"] = {material};
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    return builder;
}

Material material_of(const Json& json, const LoadOptions& options = {}) {
    return loaded_gltf(with_material(json), options).materials.at(0);
}

TEST(GltfScene, gltf_and_glb_with_the_same_content_are_the_same_scene) {
    const test::TemporaryFolder folder;
    const GltfBuilder builder = test::triangle();
    const Scene a = load_scene(builder.save_gltf(folder / "a.gltf")),
                b = load_scene(builder.save_glb(folder / "b.glb"));
    EXPECT_EQ(a.meshes[0].primitives[0].positions, b.meshes[0].primitives[0].positions);
    EXPECT_TRUE(a.notes.empty());
    EXPECT_TRUE(b.notes.empty());
}

TEST(GltfScene, parents_come_before_children_and_only_the_default_scene_counts) {
    GltfBuilder builder = test::triangle();
    builder.json["nodes"] = {{{"name", "leaf"}, {"mesh", 0}},
                             {{"name", "root"}, {"children", {3, 0}}},
                             {{"name", "other"}},
                             {{"name", "first"}}};
    builder.json["scenes"] = {{{"nodes", {2}}}, {{"nodes", {1}}}};
    builder.json["scene"] = 1;
    const Scene scene = loaded_gltf(builder);
    EXPECT_EQ(scene.order, (std::vector<int>{1, 3, 0}));
    EXPECT_EQ(scene.nodes[0].parent, 1);
}

TEST(GltfScene, cameras_are_named_after_their_nodes) {
    GltfBuilder builder = test::triangle();
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}}};
    builder.json["nodes"].push_back({{"name", "door"}, {"camera", 0}, {"translation", {0, 2, 0}}});
    builder.json["nodes"].push_back({{"camera", 1}});
    builder.json["scenes"][0]["nodes"] = {0, 1, 2};
    const Scene scene = loaded_gltf(builder);
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "door");
    EXPECT_EQ(scene.cameras[0].vertical_fov, 0.5f);
    EXPECT_EQ(scene.cameras[0].z_far, 0.0f);
    EXPECT_EQ(scene.cameras[1].name, "camera1");
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].height, 6.0f);
    EXPECT_EQ(camera_view(scene, pose_scene(scene), "door").eye, Vec3(0, 2, 0));
    try {
        camera_view(scene, pose_scene(scene), "window");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("door, camera1"), std::string::npos);
    }
}

TEST(GltfScene, lights_have_the_extension_s_defaults) {
    GltfBuilder builder = test::triangle();
    builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 40}, {"color", {1, 0.5, 0}}},
        {{"type", "spot"}, {"range", 4}, {"spot", Json::object()}},
        {{"type", "directional"}}};
    for (int i = 0; i < 3; ++i) {
        Json node;
        node["extensions"]["KHR_lights_punctual"]["light"] = i;
        builder.json["nodes"].push_back(node);
    }
    builder.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = loaded_gltf(builder, {.unit = 0.5});
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].intensity, Rgb(40, 20, 0));
    EXPECT_EQ(scene.lights[1].kind, LightKind::Spot);
    EXPECT_EQ(scene.lights[1].intensity, Rgb(1));
    EXPECT_EQ(scene.lights[1].range, 2.0f);
    EXPECT_NEAR(scene.lights[1].outer_cone, kPi / 4, 1e-6);
    EXPECT_EQ(scene.lights[2].kind, LightKind::Directional);
}

TEST(GltfScene, extras_say_what_is_lit_in_the_evening) {
    const Json evening = {{"daylit", {{"lit", "evening"}}}};
    GltfBuilder builder = with_material({{"emissiveFactor", {1, 1, 1}}, {"extras", evening}});
    builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
    builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"extras", evening}},
        {{"type", "point"}, {"extras", {{"daylit", {{"lit", "always"}}}}}},
        {{"type", "point"}, {"extras", {{"daylit", {{"lit", "at noon"}}}}}}};
    for (int i = 0; i < 3; ++i) {
        Json node;
        node["extensions"]["KHR_lights_punctual"]["light"] = i;
        builder.json["nodes"].push_back(node);
    }
    builder.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
    const Scene scene = loaded_gltf(builder);
    EXPECT_EQ(scene.materials[0].lit, Lit::Evening);
    EXPECT_EQ(scene.materials.back().lit, Lit::Always);
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].lit, Lit::Evening);
    EXPECT_EQ(scene.lights[1].lit, Lit::Always);
    EXPECT_EQ(scene.lights[2].lit, Lit::Always);
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_NE(scene.notes[0].find("extras.daylit.lit"), std::string::npos) << scene.notes[0];
    EXPECT_EQ(placed_lights(scene, pose_scene(scene))[0].lit, Lit::Evening);
    const SceneFacts facts = scene_facts(scene);
    EXPECT_EQ(facts.evening_lights, 1u);
    EXPECT_EQ(facts.evening_triangles, 1u);
}

TEST(GltfScene, a_bare_material_is_gltf_s_default) {
    const Material material = material_of(Json::object());
    EXPECT_EQ(material.base_color, Rgba(1));
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 1.0f);
    EXPECT_EQ(material.alpha_mode, AlphaMode::Opaque);
    EXPECT_EQ(material.alpha_cutoff, 0.5f);
    EXPECT_EQ(material.emission, Rgb(0));
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_FALSE(material.unlit);
}

TEST(GltfScene, primitives_without_a_material_get_the_default_one) {
    const Scene scene = loaded_gltf(test::triangle());
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.meshes[0].primitives[0].material, 0);
}

TEST(GltfScene, material_extensions) {
    EXPECT_EQ(material_of({{"emissiveFactor", {1, 0.5, 0}},
                           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1000}}}}}})
                  .emission,
              Rgb(1000, 500, 0));
    EXPECT_TRUE(material_of({{"extensions", {{"KHR_materials_unlit", Json::object()}}}}).unlit);
    EXPECT_EQ(material_of({{"extensions", {{"KHR_materials_ior", {{"ior", 1.33}}}}}}).ior, 1.33f);
    EXPECT_EQ(
        material_of({{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}}}}}}).transmission,
        0.9f);
    const Material coat = material_of(
        {{"extensions", {{"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0, 0}}}}}}});
    EXPECT_EQ(coat.specular, 0.5f);
    EXPECT_EQ(coat.specular_color, Rgb(1, 0, 0));
}

TEST(GltfScene, specular_glossiness_reflects_what_it_says) {
    const Scene scene = loaded_gltf(with_material({{"extensions",
                                               {{"KHR_materials_pbrSpecularGlossiness",
                                                 {{"diffuseFactor", {0.5, 0.25, 0, 1}},
                                                  {"specularFactor", {0.2, 0.4, 0.6}},
                                                  {"glossinessFactor", 0.75}}}}}}));
    const glsl::Brdf brdf = surface_brdf(scene, scene.materials[0], {}, Rgba(1));
    // The extension: diffuse is scaled by 1 - max(specular) = 0.4.
    EXPECT_NEAR(brdf.diffuse.x, 0.2f, 1e-6f);
    EXPECT_NEAR(brdf.diffuse.y, 0.1f, 1e-6f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(brdf.specular[c], 0.2f * float(c + 1), 1e-6f);
    EXPECT_EQ(scene.materials[0].roughness, 0.25f);
}

TEST(GltfScene, a_glossiness_texture_becomes_roughness) {
    const test::TemporaryFolder folder;
    write_image(folder / "p.png", Image(1, 1, Rgb(1)));  // alpha 1
    GltfBuilder builder = with_material({{"extensions",
                                          {{"KHR_materials_pbrSpecularGlossiness",
                                            {{"glossinessFactor", 0.75},
                                             {"specularFactor", {0.5, 0.5, 0.5}},
                                             {"specularGlossinessTexture", {{"index", 0}}}}}}}});
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", "p.png"}}};
    const Scene scene = load_scene(builder.save_gltf(folder / "s.gltf"));
    const glsl::Brdf brdf = surface_brdf(scene, scene.materials[0], {}, Rgba(1));
    EXPECT_NEAR(brdf.specular.x, 0.5f, 1e-5f);
    EXPECT_NEAR(brdf.exponent, 2.0f / std::pow(0.25f, 4.0f) - 2.0f, 12.0f);  // roughness 64/255 for 1/4
}

TEST(GltfScene, a_glossiness_texture_colours_the_coat_texel_by_texel) {
    const test::TemporaryFolder folder;
    Image picture(2, 1, Rgb(1, 0.25f, 0));
    picture.at(1, 0) = Rgb(0, 1, 0.5f);
    write_image(folder / "p.png", picture);
    GltfBuilder builder = with_material({{"extensions",
                                          {{"KHR_materials_pbrSpecularGlossiness",
                                            {{"diffuseFactor", {1, 1, 1, 1}},
                                             {"specularFactor", {0.5, 0.5, 0.8}},
                                             {"specularGlossinessTexture", {{"index", 0}}}}}}}});
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", "p.png"}}};
    const Scene scene = load_scene(builder.save_gltf(folder / "s.gltf"));
    EXPECT_FALSE(noted(scene, "averaged"));
    const auto brdf = [&](float u) {
        return surface_brdf(scene, scene.materials[0], {Vec2(u, 0.5f), Vec2(0)}, Rgba(1));
    };
    const glsl::Brdf left = brdf(0.25f), right = brdf(0.75f);
    for (int c = 0; c < 3; ++c) {  // within the steps of 8 bits
        EXPECT_NEAR(left.specular[c], Rgb(0.5f, 0.125f, 0)[c], 3e-3f) << c;
        EXPECT_NEAR(right.specular[c], Rgb(0, 0.5f, 0.4f)[c], 3e-3f) << c;
        EXPECT_NEAR(left.diffuse[c], 0.5f, 1e-5f) << c;  // 1 - max(specular)
    }
}

/// A triangle whose material has three textures of KHR_materials_specular and KHR_materials_transmission.
GltfBuilder with_coat_textures(const test::TemporaryFolder& folder) {
    const auto transformed = [](int texture, double u, int uv_set) {
        return Json{{"index", texture},
                    {"texCoord", uv_set},
                    {"extensions", {{"KHR_texture_transform", {{"offset", {u, 0}}, {"scale", {2, 1}}}}}}};
    };
    GltfBuilder builder =
        with_material({{"extensions",
                        {{"KHR_materials_specular",
                          {{"specularFactor", 0.5},
                           {"specularTexture", transformed(0, 0.25, 1)},
                           {"specularColorTexture", transformed(1, 0.5, 0)}}},
                         {"KHR_materials_transmission",
                          {{"transmissionFactor", 0.75}, {"transmissionTexture", transformed(2, 0.75, 1)}}}}}});
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = builder.floats("VEC2", {0, 0, 1, 0, 0, 1});
    for (const int i : {0, 1, 2}) {
        const std::string name = std::to_string(i) + ".png";
        write_image(folder / name, Image(1, 1, Rgb(float(i) / 2)));
        builder.json["textures"].push_back({{"source", i}});
        builder.json["images"].push_back({{"uri", name}});
    }
    return builder;
}

TEST(GltfScene, specular_and_transmission_textures) {
    const test::TemporaryFolder folder;
    const Scene scene = load_scene(with_coat_textures(folder).save_gltf(folder / "s.gltf"));
    const Material& material = scene.materials[0];
    const auto expect = [&](const TextureRef& ref, int image, float u, int uv_set) {
        ASSERT_GE(ref.texture, 0);
        EXPECT_EQ(scene.textures[std::size_t(ref.texture)].image, image);
        EXPECT_EQ(ref.uv_set, uv_set);
        EXPECT_EQ(ref.transform, (std::array<float, 6>{2, 0, u, 0, 1, 0}));
    };
    ASSERT_EQ(scene.images.size(), 3u);
    expect(material.specular_texture, 0, 0.25f, 1);
    expect(material.specular_color_texture, 1, 0.5f, 0);
    expect(material.transmission_texture, 2, 0.75f, 1);
    EXPECT_EQ(material.specular, 0.5f);
    EXPECT_EQ(material.transmission, 0.75f);
    EXPECT_FALSE(noted(scene, "ignored"));
    EXPECT_TRUE(noted(scene, "has no TEXCOORD_1"));
}

TEST(GltfScene, lambert_reads_no_specular_or_transmission_texture) {
    const test::TemporaryFolder folder;
    const Scene scene = load_scene(with_coat_textures(folder).save_gltf(folder / "s.gltf"), {.lambert = true});
    for (const TextureRef* ref : scene.materials[0].textures()) EXPECT_EQ(ref->texture, -1);
    EXPECT_TRUE(scene.images.empty());
    EXPECT_TRUE(noted(scene, "used by no material"));
}

TEST(GltfScene, lambert_leaves_colour_and_emission) {
    const GltfBuilder builder =
        with_material({{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"roughnessFactor", 0.1}}},
                       {"emissiveFactor", {1, 1, 1}},
                       {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}});
    const Scene scene = loaded_gltf(builder, {.lambert = true});
    const glsl::Brdf brdf = surface_brdf(scene, scene.materials[0], {}, Rgba(1));
    EXPECT_EQ(brdf.diffuse, Rgb(0.5f));
    EXPECT_EQ(brdf.specular, Rgb(0.0f));
    EXPECT_EQ(scene.materials[0].transmission, 0.0f);
    EXPECT_EQ(scene.materials[0].emission, Rgb(1.0f));
}

TEST(GltfScene, values_out_of_range_are_clamped_with_a_note) {
    const Scene scene = loaded_gltf(with_material({{"pbrMetallicRoughness", {{"roughnessFactor", 7}}}}));
    EXPECT_EQ(scene.materials[0].roughness, 1.0f);
    EXPECT_TRUE(noted(scene, "roughnessFactor"));
}

TEST(GltfScene, extensions_required_optional_and_known) {
    GltfBuilder builder = test::triangle();
    builder.json["extensionsUsed"] = {"KHR_materials_sheen", "KHR_materials_unlit"};
    const Scene scene = loaded_gltf(builder);
    EXPECT_TRUE(noted(scene, "KHR_materials_sheen"));
    EXPECT_FALSE(noted(scene, "KHR_materials_unlit"));
    builder.json["extensionsRequired"] = {"KHR_materials_unlit"};
    EXPECT_NO_THROW(loaded_gltf(builder));
    builder.json["extensionsRequired"] = {"KHR_materials_sheen"};
    try {
        loaded_gltf(builder);
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("KHR_materials_sheen"), std::string::npos);
    }
}

/// Sparse images: a picture with a space in its name beside the file, one in a data URI, one in a buffer view.
TEST(GltfScene, images_outside_inside_and_in_uris) {
    const test::TemporaryFolder folder;
    Image picture(2, 1, Rgb(1, 0, 0));
    picture.at(1, 0) = Rgb(0, 0, 1);
    write_image(folder / "a picture.png", picture);
    const auto bytes = read_file(folder / "a picture.png");
    GltfBuilder builder = with_material(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}},
         {"emissiveTexture", {{"index", 2}}}});
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = builder.floats("VEC2", {0, 0, 1, 0, 0, 1});
    builder.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}, {{"source", 2}}, {{"source", 3}}};
    builder.json["samplers"] = {{{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}}};
    builder.json["images"] = {{{"uri", "a%20picture.png"}},
                              {{"uri", "data:image/png;base64," + test::base64(bytes)}},
                              {{"bufferView", builder.view(bytes)}, {"mimeType", "image/png"}},
                              {{"uri", "absent and unused.png"}}};
    const Scene scene = load_scene(builder.save_gltf(folder / "scene.gltf"));
    ASSERT_EQ(scene.images.size(), 3u);
    for (const Image8& image : scene.images)
        EXPECT_EQ(image.rgba, (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255}));
    ASSERT_EQ(scene.textures.size(), 3u);
    EXPECT_EQ(scene.textures[0].filter, Filter::Nearest);
    EXPECT_EQ(scene.textures[0].wrap_s, Wrap::Clamp);
    EXPECT_EQ(scene.textures[0].wrap_t, Wrap::Mirror);
    EXPECT_EQ(scene.textures[1].wrap_s, Wrap::Repeat);
    EXPECT_TRUE(noted(scene, "used by no material"));
}

TEST(GltfScene, texture_transforms_turn_pictures_clockwise) {
    // Khronos' TextureTransformTest: an arrow along the picture's diagonal, turned by 22.5 degrees, points 67.5 degrees
    // below the horizontal. What lies there must be read from the diagonal.
    const test::TemporaryFolder folder;
    write_image(folder / "p.png", Image(1, 1, Rgb(1)));
    GltfBuilder builder = with_material(
        {{"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 0},
             {"extensions",
              {{"KHR_texture_transform",
                {{"rotation", kPi / 8}, {"offset", {0.25, 0.5}}, {"scale", {2, 2}}, {"texCoord", 1}}}}}}}}}});
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["images"] = {{{"uri", "p.png"}}};
    const TextureRef ref = load_scene(builder.save_gltf(folder / "s.gltf")).materials[0].base_color_texture;
    EXPECT_EQ(ref.uv_set, 1);
    const auto& m = ref.transform;
    const float u = float(std::cos(67.5 * kDegree)), v = float(std::sin(67.5 * kDegree));
    EXPECT_NEAR(m[0] * u + m[1] * v + m[2], 0.25 + 2 * std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(m[3] * u + m[4] * v + m[5], 0.5 + 2 * std::sqrt(0.5), 1e-6);
}

TEST(GltfScene, instances_are_placed_each) {
    GltfBuilder builder = test::triangle();
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const int places = builder.floats("VEC3", {0, 0, 0, 10, 0, 0}), scales = builder.floats("VEC3", {1, 1, 1, 2, 2, 2});
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", places},
                                                                                       {"SCALE", scales}};
    builder.json["nodes"][0]["translation"] = {0, 5, 0};
    const Scene scene = loaded_gltf(builder);
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::All);
    EXPECT_EQ(mesh.triangle_count(), 2u);
    EXPECT_EQ(mesh.positions[1], Vec3(1, 5, 0));
    EXPECT_EQ(mesh.positions[4], Vec3(12, 5, 0));
}

TEST(GltfScene, extras_daylit) {
    GltfBuilder builder = test::triangle();
    builder.json["scenes"][0]["extras"]["daylit"] = {{"latitude", -33.5}, {"date", "2025-12-21"}, {"clouds", 0.25}};
    builder.json["nodes"][0]["extras"]["daylit"]["dynamic"] = true;
    const Scene scene = loaded_gltf(builder);
    EXPECT_EQ(scene.extras.latitude, -33.5);
    EXPECT_EQ(scene.extras.date, (Date{2025, 12, 21}));
    EXPECT_EQ(scene.extras.clouds, 0.25);
    EXPECT_FALSE(scene.extras.longitude.has_value());
    EXPECT_TRUE(scene.nodes[0].dynamic);
}

TEST(GltfScene, dynamic_is_what_is_animated_below_it_or_skinned_by_it) {
    GltfBuilder builder = test::triangle();
    const int times = builder.floats("SCALAR", {0, 1}), places = builder.floats("VEC3", {0, 0, 0, 1, 0, 0});
    const int joints = builder.accessor<std::uint8_t>("VEC4", 5121, std::vector<std::uint8_t>(12, 0));
    const int weights = builder.floats("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    builder.json["meshes"].push_back(builder.json["meshes"][0]);
    builder.json["meshes"][1]["primitives"][0]["attributes"]["JOINTS_0"] = joints;
    builder.json["meshes"][1]["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
    builder.json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"mesh", 0}}, {{"mesh", 1}, {"skin", 0}}};
    builder.json["scenes"][0]["nodes"] = {0, 1, 3};
    builder.json["skins"] = {{{"joints", {2}}}};
    builder.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", places}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
    const Scene scene = loaded_gltf(builder);
    EXPECT_FALSE(scene.nodes[0].dynamic);
    EXPECT_TRUE(scene.nodes[1].dynamic);
    EXPECT_TRUE(scene.nodes[2].dynamic);
    EXPECT_TRUE(scene.nodes[3].dynamic);
    EXPECT_EQ(world_mesh(scene, pose_scene(scene), Part::Static).triangle_count(), 1u);
    EXPECT_EQ(world_mesh(scene, pose_scene(scene), Part::Dynamic).triangle_count(), 2u);
}

TEST(GltfScene, an_empty_file_is_an_empty_scene) {
    GltfBuilder builder;
    const Scene scene = loaded_gltf(builder);
    EXPECT_TRUE(scene.order.empty());
    EXPECT_TRUE(bounds(world_mesh(scene, pose_scene(scene), Part::All)).empty());
}

}  // namespace
}  // namespace daylit
