// Facts of a scene and what they ask of a bake (design.md, section 5).
#include "engine/baked/part_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daylit {
namespace {

bool needed(const std::vector<PlanItem>& plan, const std::string& part) {
    const auto found = std::find_if(plan.begin(), plan.end(), [&](const PlanItem& item) { return item.part == part; });
    EXPECT_NE(found, plan.end()) << part;
    EXPECT_FALSE(found->why.empty()) << part;
    return found->done;
}

/// `nodes` nodes that each place one triangle with one material.
Scene triangles(const Material& material, bool dynamic) {
    Primitive primitive;
    primitive.positions = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    primitive.normals.assign(3, Vec3(0, 0, 1));
    primitive.indices = {0, 1, 2};
    Scene scene;
    scene.materials = {material};
    scene.meshes.push_back({"", {primitive}, {}});
    scene.nodes.emplace_back();
    scene.nodes[0].mesh = 0;
    scene.nodes[0].dynamic = dynamic;
    scene.order = {0};
    return scene;
}

Material matt() {
    Material material;
    material.metallic = 0;
    return material;
}

TEST(PartPlan, a_matt_still_scene_needs_a_lightmap_alone) {
    const auto plan = plan_parts(scene_facts(triangles(matt(), false)));
    EXPECT_TRUE(needed(plan, "lightmap"));
    for (const char* part : {"volume", "dirmap", "antiradiance", "caustics"}) EXPECT_FALSE(needed(plan, part)) << part;
}

TEST(PartPlan, a_moving_object_alone_needs_no_lightmap) {
    const SceneFacts facts = scene_facts(triangles(matt(), true));
    EXPECT_EQ(facts.dynamic_triangles, 1u);
    const auto plan = plan_parts(facts);
    EXPECT_FALSE(needed(plan, "lightmap"));
    EXPECT_TRUE(needed(plan, "volume"));
    EXPECT_TRUE(needed(plan, "antiradiance"));
}

TEST(PartPlan, gloss_counts_on_static_surfaces_only) {
    Material brass = matt();
    brass.metallic = 1;
    brass.roughness = 0.3f;  // exponent 2 / 0.09^2 - 2 = 245
    EXPECT_NEAR(scene_facts(triangles(brass, false)).static_exponent, 244.9f, 0.1f);
    EXPECT_TRUE(needed(plan_parts(scene_facts(triangles(brass, false))), "dirmap"));
    EXPECT_FALSE(needed(plan_parts(scene_facts(triangles(brass, true))), "dirmap"));
}

TEST(PartPlan, a_texture_can_be_what_makes_it_glossy) {
    Material material = matt();
    material.roughness = 1.0f;
    material.metallic_roughness_texture.texture = 0;
    Scene scene = triangles(material, false);
    scene.images.push_back({2, 1, {0, 255, 0, 255, 0, 51, 0, 255}});  // roughness 1 and 0.2
    scene.textures.push_back({.image = 0});
    EXPECT_NEAR(scene_facts(scene).static_exponent, 2.0f / 0.0016f - 2.0f, 1.0f);
}

TEST(PartPlan, a_coat_is_as_glossy_as_its_brightest_texel) {
    Material material = matt();
    material.roughness = 0.3f;
    material.specular_color = Rgb(25.0f);  // f0 = 1: of a specular-glossiness material
    material.specular_color_texture.texture = 0;
    Scene scene = triangles(material, false);
    scene.images.push_back({2, 1, {0, 0, 0, 255, 188, 188, 188, 51}});
    scene.textures.push_back({.image = 0});
    EXPECT_NEAR(scene_facts(scene).static_exponent, 244.9f, 0.1f);
    scene.materials[0].specular_texture.texture = 0;  // 0.5 of 0.2 is visible still
    EXPECT_NEAR(scene_facts(scene).static_exponent, 244.9f, 0.1f);
    scene.images[0].rgba = {0, 0, 0, 255, 22, 22, 22, 255};  // 0.008
    EXPECT_EQ(scene_facts(scene).static_exponent, 0.0f);
}

TEST(PartPlan, glass_and_mirrors_need_caustics) {
    Material glass = matt(), mirror = matt();
    glass.transmission = 1;
    mirror.metallic = 1;
    mirror.roughness = 0;
    EXPECT_TRUE(needed(plan_parts(scene_facts(triangles(glass, true))), "caustics"));
    EXPECT_TRUE(needed(plan_parts(scene_facts(triangles(mirror, false))), "caustics"));
}

TEST(PartPlan, asking_overrides_all_but_the_impossible) {
    const std::vector<std::string> asked = {"volume"};
    const auto plan = plan_parts(scene_facts(triangles(matt(), false)), asked);
    EXPECT_TRUE(needed(plan, "volume"));
    EXPECT_FALSE(needed(plan, "lightmap"));
    const std::vector<std::string> lightmap = {"lightmap"};
    EXPECT_FALSE(needed(plan_parts(scene_facts(triangles(matt(), true)), lightmap), "lightmap"));
}

TEST(PartPlan, what_this_version_does_not_bake_is_left_out_and_said_to_be_missed) {
    Material mirror = matt();
    mirror.metallic = 1;
    mirror.roughness = 0;
    const auto plan = plan_parts(scene_facts(triangles(mirror, false))), now = plan_of_this_version(plan);
    for (std::size_t i = 0; i < plan.size(); ++i) {
        EXPECT_EQ(now[i].done, plan[i].done && bakes_part(plan[i].part)) << plan[i].part;
        const bool missed = plan[i].done && !now[i].done;
        EXPECT_EQ(now[i].why.find("not baked by this version") != std::string::npos, missed) << now[i].why;
    }
    EXPECT_TRUE(needed(now, "lightmap"));
    EXPECT_FALSE(needed(now, "caustics"));
}

}  // namespace
}  // namespace daylit
