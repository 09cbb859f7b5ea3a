#include "engine/scene/texture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daylit {
namespace {

/// A 2 x 1 picture: black, white (coded 0 and 255); alpha 255 and 0.
struct TwoTexels : testing::Test {
    TwoTexels() {
        scene.images.push_back({2, 1, {0, 0, 0, 255, 255, 255, 255, 0}});
        scene.textures.push_back({.image = 0});
        ref.texture = 0;
    }
    float red(float u, float v = 0.5f) const { return sample_texture(scene, ref, {Vec2(u, v), Vec2(0)}).r; }
    Scene scene;
    TextureRef ref;
};

TEST_F(TwoTexels, texel_centres_lie_at_halves) {
    EXPECT_FLOAT_EQ(red(0.25f), 0.0f);
    EXPECT_FLOAT_EQ(red(0.75f), 1.0f);
    EXPECT_FLOAT_EQ(red(0.5f), 0.5f);
}

TEST_F(TwoTexels, wrap_modes) {
    EXPECT_FLOAT_EQ(red(0.0f), 0.5f);  // repeat: half of the texel at the other end
    EXPECT_FLOAT_EQ(red(-0.25f), 1.0f);
    EXPECT_FLOAT_EQ(red(1001.25f), 0.0f);
    scene.textures[0].wrap_s = Wrap::Clamp;
    EXPECT_FLOAT_EQ(red(0.0f), 0.0f);
    EXPECT_FLOAT_EQ(red(7.0f), 1.0f);
    EXPECT_FLOAT_EQ(red(-1e30f), 0.0f);
    scene.textures[0].wrap_s = Wrap::Mirror;
    EXPECT_FLOAT_EQ(red(-0.25f), 0.0f);
    EXPECT_FLOAT_EQ(red(1.25f), 1.0f);
    EXPECT_FLOAT_EQ(red(1.75f), 0.0f);
}

TEST_F(TwoTexels, nearest_takes_the_texel_that_holds_the_point) {
    scene.textures[0].filter = Filter::Nearest;
    EXPECT_FLOAT_EQ(red(0.49f), 0.0f);
    EXPECT_FLOAT_EQ(red(0.51f), 1.0f);
}

TEST_F(TwoTexels, coordinates_that_are_no_numbers_do_no_harm) {
    for (const Wrap wrap : {Wrap::Repeat, Wrap::Mirror, Wrap::Clamp}) {
        scene.textures[0].wrap_s = scene.textures[0].wrap_t = wrap;
        for (const float u : {std::nanf(""), INFINITY, -INFINITY, 1e38f, -1e38f}) {
            const float value = red(u, u);
            EXPECT_TRUE(value >= 0 && value <= 1) << u;
        }
    }
}

TEST_F(TwoTexels, srgb_is_decoded_before_mixing_and_alpha_not_at_all) {
    const Rgba middle = sample_texture_srgb(scene, ref, {Vec2(0.5f, 0.5f), Vec2(0)});
    EXPECT_FLOAT_EQ(middle.r, 0.5f);  // the mean of linear 0 and 1; mixing first would give 0.214
    EXPECT_FLOAT_EQ(middle.a, 0.5f);
}

TEST_F(TwoTexels, the_uv_set_and_transform_are_the_reference_s_own) {
    ref.uv_set = 1;
    EXPECT_FLOAT_EQ(sample_texture(scene, ref, {Vec2(0.25f), Vec2(0.75f)}).r, 1.0f);
    ref.transform = {1, 0, -0.5f, 0, 1, 0};
    EXPECT_FLOAT_EQ(sample_texture(scene, ref, {Vec2(0.25f), Vec2(0.75f)}).r, 0.0f);
}

TEST_F(TwoTexels, coverage_by_alpha_mode) {
    Material material;
    material.base_color = Rgba(0.5f, 1, 1, 0.8f);
    material.base_color_texture = ref;
    const auto alpha = [&](float u) {
        return base_color(scene, material, {Vec2(u, 0.5f), Vec2(0)}, Rgba(1, 1, 1, 0.5f)).a;
    };
    EXPECT_EQ(alpha(0.25f), 1.0f);
    material.alpha_mode = AlphaMode::Blend;
    EXPECT_FLOAT_EQ(alpha(0.25f), 0.4f);
    material.alpha_mode = AlphaMode::Mask;
    material.alpha_cutoff = 0.4f;
    EXPECT_EQ(alpha(0.25f), 1.0f);
    EXPECT_EQ(alpha(0.3f), 0.0f);
}

TEST(Material, dielectrics_and_metals) {
    Scene scene;
    Material material;
    material.base_color = Rgba(0.5f, 0.25f, 0, 1);
    material.metallic = 0;
    material.roughness = 0.5f;
    glsl::Brdf brdf = surface_brdf(scene, material, {}, Rgba(1));
    EXPECT_NEAR(brdf.diffuse.x, 0.48f, 1e-6f);  // f0 = ((1.5 - 1) / (1.5 + 1))^2 = 0.04
    EXPECT_NEAR(brdf.specular.y, 0.04f, 1e-7f);
    EXPECT_NEAR(brdf.exponent, 30.0f, 1e-4f);  // alpha = 1/4: 2 * 16 - 2
    material.metallic = 1;
    brdf = surface_brdf(scene, material, {}, Rgba(1));
    EXPECT_EQ(brdf.diffuse, Rgb(0));
    EXPECT_EQ(brdf.specular, Rgb(0.5f, 0.25f, 0));
    material.unlit = true;
    brdf = surface_brdf(scene, material, {}, Rgba(1));
    EXPECT_EQ(brdf.diffuse + brdf.specular, Rgb(0));
}

/// A 2 x 1 picture: 0 on the left; on the right sRGB 0.5029 in red, 1 in green, 0 in blue, 0.2 in alpha.
struct CoatTexels : testing::Test {
    CoatTexels() {
        scene.images.push_back({2, 1, {0, 0, 0, 0, 188, 255, 0, 51}});
        scene.textures.push_back({.image = 0});
        material.base_color = Rgba(0.5f, 0.5f, 0.5f, 1);
        material.metallic = 0;
    }
    glsl::Brdf brdf(float u) const { return surface_brdf(scene, material, {Vec2(0), Vec2(u, 0.5f)}, Rgba(1)); }
    Scene scene;
    Material material;
    TextureRef ref{.texture = 0, .uv_set = 1};
};

TEST_F(CoatTexels, the_specular_texture_s_alpha_scales_the_coat) {
    material.specular = 0.5f;
    material.specular_texture = ref;
    EXPECT_EQ(brdf(0.25f).specular, Rgb(0));
    EXPECT_EQ(brdf(0.25f).diffuse, Rgb(0.5f));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(brdf(0.75f).specular[c], 0.04f * 0.5f * 0.2f, 1e-7f);
        EXPECT_NEAR(brdf(0.75f).diffuse[c], 0.5f * (1 - 0.004f), 1e-6f);
    }
}

TEST_F(CoatTexels, the_specular_colour_texture_s_light_tints_the_coat) {
    material.specular_color = Rgb(5, 10, 20);
    material.specular_color_texture = ref;
    EXPECT_EQ(brdf(0.25f).specular, Rgb(0));
    const Rgb f0(0.2f * 0.502886f, 0.4f, 0);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(brdf(0.75f).specular[c], f0[c], 1e-6f);
        EXPECT_NEAR(brdf(0.75f).diffuse[c], 0.5f * (1 - 0.4f), 1e-6f);
    }
    // KHR_materials_specular cuts at 1 before it scales.
    material.specular_color.g = 50;
    material.specular_texture = ref;
    EXPECT_NEAR(brdf(0.75f).specular.g, 0.2f, 1e-6f);
}

TEST_F(CoatTexels, the_transmission_texture_s_red_scales_the_share_of_glass) {
    const auto share = [&](float u) { return transmission(scene, material, {Vec2(0), Vec2(u, 0.5f)}); };
    material.transmission_texture = ref;
    EXPECT_EQ(share(0.75f), 0.0f);
    material.transmission = 0.5f;
    EXPECT_EQ(share(0.25f), 0.0f);
    EXPECT_NEAR(share(0.75f), 0.5f * 188.0f / 255.0f, 1e-6f);
    material.transmission_texture = TextureRef();
    EXPECT_EQ(share(0.25f), 0.5f);
}

TEST(Material, never_reflects_more_than_it_gets) {
    Scene scene;
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float ior : {0.0f, 1.0f, 1.5f, 3.0f}) {
            Material material;
            material.metallic = metallic;
            material.ior = ior;
            material.specular_color = Rgb(1, 30, 0);
            const glsl::Brdf brdf = surface_brdf(scene, material, {}, Rgba(1));
            for (int c = 0; c < 3; ++c) EXPECT_LE(brdf.diffuse[c] + brdf.specular[c], 1.0f + 1e-6f);
        }
}

TEST(Material, normal_maps_tilt_along_tangent_and_bitangent) {
    Scene scene;
    scene.images.push_back({1, 1, {255, 128, 128, 255}});  // +x, nearly nothing else
    scene.textures.push_back({.image = 0});
    Material material;
    material.normal_texture.texture = 0;
    const Vec3 n = shading_normal(scene, material, {}, Vec3(0, 0, 1), Vec4(0, 1, 0, 1));
    EXPECT_GT(n.y, 0.99f);
    EXPECT_NEAR(glm::length(n), 1.0f, 1e-6f);
    material.normal_scale = 0.0f;
    EXPECT_NEAR(shading_normal(scene, material, {}, Vec3(0, 0, 1), Vec4(0, 1, 0, 1)).z, 1.0f, 1e-6f);
    EXPECT_EQ(shading_normal(scene, material, {}, Vec3(0, 0, 1), Vec4(0)), Vec3(0, 0, 1));
}

}  // namespace
}  // namespace daylit
