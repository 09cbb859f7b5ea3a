// Pictures whose pixels can be worked out on paper.
#include "engine/render/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>

#include "engine/base/error.h"
#include "engine/base/exposure.h"
#include "engine/scene/texture.h"
#include "small_scenes.h"

namespace daylit {
namespace {

using namespace render_tests;

/// A context that turns every GL error of the test into a failure.
class RendererTest : public testing::Test {
  protected:
    void TearDown() override { EXPECT_NO_THROW(check_gl()); }
    std::unique_ptr<GlContext> context_ = make_any_context({.debug = true});
};

float relative(float value, double expected) {
    return float(std::abs(value / expected - 1.0));
}

TEST_F(RendererTest, plane_under_the_sun_is_albedo_e_cos_over_pi_gl) {
    const Scene scene = scene_of({ground(Vec3(0), 5, 5, 0)}, {lambert({0.5f, 0.25f, 0.75f})});
    Renderer renderer(scene, nullptr);
    for (const float elevation : {90.0f, 60.0f, 30.0f, 12.0f}) {
        const float e = elevation * float(kDegree);
        renderer.set_lighting(one_sun({std::cos(e), std::sin(e), 0.3f * std::cos(e)}, 100000.0f));
        const float sine = std::sin(e) / std::sqrt(1.0f + 0.09f * std::cos(e) * std::cos(e));
        renderer.draw(frame_of(from_above(1.0f), 16, 16));
        const Image image = renderer.read_radiance();
        for (const Rgb& pixel : image.pixels) {
            EXPECT_LT(relative(pixel.r, 0.5 * 100000.0 * sine / kPi), 0.005) << elevation;
            EXPECT_LT(relative(pixel.b, 0.75 * 100000.0 * sine / kPi), 0.005) << elevation;
        }
    }
}

TEST_F(RendererTest, plane_under_a_lamp_is_intensity_over_distance_squared_gl) {
    Scene scene = scene_of({ground(Vec3(0), 5, 5, 0)}, {lambert(Rgb(0.5f))});
    add_lamp(scene, {0, 2, 0});
    Renderer renderer(scene, nullptr);
    renderer.set_lighting({{}, {Image(1, 1)}});
    renderer.draw(frame_of(from_above(6.0f, Vec3(0), 3.0f), 61, 61));
    const Image image = renderer.read_radiance();
    for (const int x : {30, 40, 50, 58}) {
        const double away = (x + 0.5 - 30.5) * 6.0 / 61.0, d2 = 4.0 + away * away;
        EXPECT_LT(relative(image.at(x, 30).g, 0.5 / kPi * 300.0 / d2 * (2.0 / std::sqrt(d2))), 0.005) << x;
    }
}

TEST_F(RendererTest, what_is_lit_in_the_evening_follows_the_dimmer_gl) {
    Material glow = lambert(Rgb(0.5f));
    glow.emission = Rgb(40.0f);
    glow.lit = Lit::Evening;
    Scene scene = scene_of({ground(Vec3(0), 5, 5, 0)}, {glow});
    add_lamp(scene, {0, 2, 0}).lit = Lit::Evening;
    Renderer renderer(scene, nullptr);
    const double full = 40.0 + 0.5 / kPi * 300.0 / 4.0;
    for (const float evening : {0.0f, 0.25f, 1.0f, 0.5f, 0.0f}) {
        Lighting lighting{{}, {Image(1, 1)}};
        lighting.scales.evening = evening;
        renderer.set_lighting(lighting);
        const FrameReport report = renderer.draw(frame_of(from_above(0.2f), 8, 8));
        EXPECT_NEAR(renderer.read_radiance().at(4, 4).g, evening * full, 0.005 * full) << evening;
        // No maps for lamps that are out, and none again for lamps that are merely dimmed.
        EXPECT_EQ(pass(report, "lamp shadows").ran, evening == 0.25f) << evening;
    }
}

/// Uncovered share of a unit disc of which everything beyond the chord at `x` (in radii from its centre) is hidden.
double disc_share(double x) {
    x = std::clamp(x, -1.0, 1.0);
    return 1.0 - (std::acos(x) - x * std::sqrt(1.0 - x * x)) / kPi;
}

TEST_F(RendererTest, penumbra_of_an_edge_is_that_of_the_disc_gl) {
    // A roof over x < 0, three metres up; the sun stands overhead.
    const Scene scene =
        scene_of({ground(Vec3(0), 5, 5, 0), ground(Vec3(-2.5f, 3, 0), 2.5f, 5, 0)}, {lambert(Rgb(0.8f))});
    Renderer renderer(scene, nullptr);
    renderer.set_lighting(one_sun({0, 1, 0}, 100000.0f));
    FrameSettings frame = frame_of(from_above(0.08f), 64, 64);
    frame.samples_per_side = 2;
    renderer.draw(frame);
    const Image image = renderer.read_radiance();
    const double radius = 3.0 * std::tan(kSunRadius);
    double error = 0.0, most = 0.0, width = 0.0;
    for (int x = 0; x < 64; ++x) {
        double lit = 0.0;
        for (int y = 0; y < 64; ++y) lit += image.at(x, y).g / (0.8 * 100000.0 / kPi) / 64.0;
        const double expected = disc_share(((x + 0.5) / 64.0 - 0.5) * 0.08 / radius);
        error += std::abs(lit - expected) / 64.0;
        most = std::max(most, std::abs(lit - expected));
        width += lit * (1.0 - lit) * 0.08 / 64.0;
    }
    EXPECT_LT(error, 0.03);
    EXPECT_LT(most, 0.12);
    double expected_width = 0.0;  // the same measure of the closed form
    for (int i = 0; i < 4096; ++i) {
        const double share = disc_share(((i + 0.5) / 4096.0 - 0.5) * 0.08 / radius);
        expected_width += share * (1.0 - share) * 0.08 / 4096.0;
    }
    EXPECT_NEAR(width / expected_width, 1.0, 0.15);
}

TEST_F(RendererTest, a_low_vault_is_dark_under_the_penumbra_of_a_far_roof_gl) {
    // The vault half a metre up hides the sun from all but what lies under its slit, half a metre aside; under the edge
    // of the roof, sixty metres up, maps hold now the one and now the other.
    const Scene scene = scene_of({ground(Vec3(0), 5, 5, 0), ground(Vec3(-2.25f, 0.5f, 0), 2.75f, 5, 0),
                                  ground(Vec3(2.8f, 0.5f, 0), 2.2f, 5, 0), ground(Vec3(-2.5f, 60, 0), 2.5f, 5, 0)},
                                 {lambert(Rgb(0.8f))});
    Renderer renderer(scene, nullptr);
    renderer.set_lighting(one_sun({0, 1, 0}, 100000.0f));
    renderer.draw(frame_of(from_above(2.0f, Vec3(0), 0.25f), 128, 128));
    const Image image = renderer.read_radiance();
    for (int x = 0; x < 128; ++x) {
        const double at = (x + 0.5) / 64.0 - 1.0;
        for (int y = 0; y < 128 && std::abs(at - 0.55) > 0.1; ++y) ASSERT_EQ(image.at(x, y).g, 0.0f) << at;
    }
    EXPECT_GT(image.at(99, 64).g, 10000.0f);
}

TEST_F(RendererTest, shadow_of_a_wall_ends_where_the_sun_says_gl) {
    // A wall of no thickness, 1 m high along z at x = 0; the sun 45 degrees up over -x: shadow from 0 to 1 m.
    Primitive wall = quad({0, 0, 2}, {0, 0, -2}, {0, 1, -2}, {0, 1, 2}, 0);
    const Scene scene = scene_of({ground(Vec3(0), 5, 5, 0), wall}, {lambert(Rgb(0.8f))});
    Renderer renderer(scene, nullptr);
    renderer.set_lighting(one_sun({-1, 1, 0}, 100000.0f));
    renderer.draw(frame_of(from_above(3.0f), 300, 300));
    const Image image = renderer.read_radiance();
    const double full = 0.8 * 100000.0 * std::sqrt(0.5) / kPi;
    double shaded = 0.0;
    for (int x = 0; x < 300; ++x) {
        const double at = (x + 0.5) / 100.0 - 1.5, lit = image.at(x, 150).g / full;
        if (at < -0.01 || at > 1.03) {
            EXPECT_NEAR(lit, 1.0, 0.005) << at;  // no acne, no dark line before the wall
        } else if (at > 0.02 && at < 0.97) {
            EXPECT_NEAR(lit, 0.0, 0.005) << at;  // no light behind its foot
        }
        shaded += (1.0 - lit) / 100.0;
    }
    EXPECT_NEAR(shaded, 1.0, 0.01);
}

/// An image whose left half has alpha 0 and whose right half has alpha 255.
Image8 half_alpha() {
    Image8 image{2, 1, {255, 255, 255, 0, 255, 255, 255, 255}};
    return image;
}

TEST_F(RendererTest, masks_cut_the_surface_and_its_shadow_gl) {
    Material leaf = lambert(Rgb(0.5f));
    leaf.alpha_mode = AlphaMode::Mask;
    leaf.base_color_texture.texture = 0;
    Scene scene = scene_of({ground(Vec3(0), 5, 5, 0), ground(Vec3(0, 1, 0), 1, 1, 1)}, {lambert(Rgb(0.8f)), leaf});
    scene.images = {half_alpha()};
    scene.image_names = {"half"};
    scene.textures = {{0, Wrap::Clamp, Wrap::Clamp, Filter::Nearest}};
    Renderer renderer(scene, nullptr);
    renderer.set_lighting(one_sun({0, 1, 0}, 1000.0f));
    renderer.draw(frame_of(from_above(4.0f), 64, 64));
    const Image image = renderer.read_radiance();
    EXPECT_NEAR(image.at(24, 32).g, 800.0 / kPi, 2.0);  // through the hole: lit ground
    EXPECT_NEAR(image.at(40, 32).g, 500.0 / kPi, 2.0);  // the leaf
    View below = from_above(4.0f, Vec3(0), 0.5f);       // between leaf and ground
    renderer.draw(frame_of(below, 64, 64));
    const Image ground_only = renderer.read_radiance();
    EXPECT_NEAR(ground_only.at(24, 32).g, 800.0 / kPi, 2.0);
    EXPECT_EQ(ground_only.at(40, 32).g, 0.0f);
}

TEST_F(RendererTest, blend_covers_and_dims_by_alpha_gl) {
    Material veil = lambert(Rgb(1.0f));
    veil.base_color.a = 0.25f;
    veil.alpha_mode = AlphaMode::Blend;
    Material lower = veil;
    lower.base_color.a = 0.5f;
    const Scene scene =
        scene_of({ground(Vec3(0), 5, 5, 0), ground(Vec3(0, 0.5f, 0), 1, 1, 2), ground(Vec3(0, 1, 0), 1, 1, 1)},
                 {lambert(Rgb(0.5f)), veil, lower});
    Renderer renderer(scene, nullptr);
    renderer.set_lighting(one_sun({0, 1, 0}, 1000.0f));
    renderer.draw(frame_of(from_above(4.0f), 64, 64));
    const Image image = renderer.read_radiance();
    const double ground_light = 0.5 * 1000.0 * 0.75 * 0.5 / kPi, lower_light = 1000.0 * 0.75 / kPi,
                 upper_light = 1000.0 / kPi;
    const double behind_upper = 0.5 * lower_light + 0.5 * ground_light;
    EXPECT_LT(relative(image.at(32, 32).g, 0.25 * upper_light + 0.75 * behind_upper), 0.005);
    EXPECT_LT(relative(image.at(4, 4).g, 500.0 / kPi), 0.005);
}

/// A ground whose right half has another texel than the left, in the second UV set alone.
Scene two_texel_ground(const Material& material, const std::vector<std::uint8_t>& rgba) {
    Primitive primitive = ground(Vec3(0), 2, 2, 0);
    primitive.uvs.push_back(primitive.uvs[0]);
    primitive.uvs[0].assign(4, Vec2(0.25f));
    Scene scene = scene_of({std::move(primitive)}, {material});
    scene.images = {{2, 1, rgba}};
    scene.image_names = {"two texels"};
    scene.textures = {{0, Wrap::Repeat, Wrap::Repeat, Filter::Nearest}};
    return scene;
}

TEST_F(RendererTest, textures_of_the_coat_are_those_of_the_cpu_gl) {
    // Turned by half a period, so that the left half shows the right texel.
    const TextureRef turned{.texture = 0, .uv_set = 1, .transform = {1, 0, 0.5f, 0, 1, 0}};
    Material coat = lambert({0.5f, 0.25f, 0.75f});
    coat.specular = 0.5f;
    coat.specular_color = Rgb(20, 10, 40);  // blue is cut
    for (const int textures : {1, 2, 3}) {
        Material material = coat;
        if (textures & 1) material.specular_texture = turned;
        if (textures & 2) material.specular_color_texture = turned;
        const Scene scene = two_texel_ground(material, {255, 188, 200, 51, 60, 255, 255, 204});
        Renderer renderer(scene, nullptr);
        renderer.set_lighting({{}, {Image(1, 1)}});
        renderer.draw(frame_of(from_above(4.0f), 64, 64, Layer::Albedo));
        const Image image = renderer.read_radiance();
        for (const float u : {0.25f, 0.75f}) {
            const glsl::Brdf brdf = surface_brdf(scene, material, {Vec2(0.25f), Vec2(u, 0.5f)}, Rgba(1.0f));
            const Rgb seen = image.at(int(64 * u), 32);
            for (int c = 0; c < 3; ++c)
                EXPECT_LT(relative(seen[c], brdf.diffuse[c] + brdf.specular[c]), 2e-3) << textures << " at " << u;
        }
    }
}

TEST_F(RendererTest, the_share_of_glass_lets_through_and_the_rest_reflects_gl) {
    // Without a coat nothing is mirrored; the floor shines, and lies in the sheet's shadow.
    Material sheet = lambert({0.75f, 0.5f, 0.25f});
    sheet.transmission = 0.8f;
    sheet.transmission_texture = {.texture = 0, .uv_set = 1, .transform = {1, 0, 0.5f, 0, 1, 0}};
    Material floor = lambert(Rgb(0.0f));
    floor.emission = Rgb(400.0f);
    Scene scene = two_texel_ground(sheet, {64, 255, 255, 255, 255, 0, 0, 0});
    Scene below = scene_of({ground(Vec3(0, -1, 0), 3, 3, 1)}, {});
    below.nodes[0].mesh = 1;
    scene.order.push_back(1);
    scene.nodes.push_back(below.nodes[0]);
    scene.meshes.push_back(below.meshes[0]);
    scene.materials.push_back(floor);
    Renderer renderer(scene, nullptr);
    renderer.set_lighting(one_sun({0, 1, 0}, 1000.0f));
    renderer.draw(frame_of(from_above(4.0f), 64, 64));
    const Image image = renderer.read_radiance();
    for (const float u : {0.25f, 0.75f}) {
        const float share = transmission(scene, sheet, {Vec2(0.25f), Vec2(u, 0.5f)});
        EXPECT_NEAR(share, u < 0.5f ? 0.8f : 0.8f * 64 / 255, 1e-6f);
        for (int c = 0; c < 3; ++c) {
            const double tint = sheet.base_color[c];
            EXPECT_LT(relative(image.at(int(64 * u), 32)[c], tint * (share * 400.0 + (1.0 - share) * 1000.0 / kPi)),
                      2e-3)
                << u;
        }
    }
}

TEST_F(RendererTest, culling_does_not_change_the_picture_gl) {
    std::vector<Primitive> quads = {ground(Vec3(0), 50, 50, 0)};
    for (int i = 0; i < 100; ++i)
        quads.push_back(ground({float(i % 10) * 4.0f - 20.0f, 0.5f + float(i % 7) * 0.2f, float(i / 10) * 4.0f - 20.0f},
                               0.5f, 0.7f, i % 2));
    const Scene scene = scene_of(quads, {lambert(Rgb(0.8f)), lambert(Rgb(0.3f))});
    Renderer culled(scene, nullptr), whole(scene, nullptr);
    FrameSettings frame = frame_of(look_at({0, 1.7f, 0}, {5, 1, 5}, 1.0f), 160, 90);
    culled.set_lighting(one_sun({1, 2, 0.5f}, 1000.0f));
    whole.set_lighting(one_sun({1, 2, 0.5f}, 1000.0f));
    culled.draw(frame);
    frame.cull = false;
    whole.draw(frame);
    const Image a = culled.read_radiance(), b = whole.read_radiance();
    EXPECT_EQ(a.pixels, b.pixels);
}

TEST_F(RendererTest, what_walls_hide_is_not_drawn_where_the_cpu_draws_gl) {
    // A floor, a wall that hides all but its rim, things of their own material behind and before it; then the wall
    // gone.
    const auto draw = [&](bool wall, bool cull) {
        std::vector<Primitive> quads = {ground(Vec3(0, -1, 0), 0.5f, 0.5f, 1), ground(Vec3(0, 1, 0), 0.1f, 0.1f, 2),
                                        ground(Vec3(0, -2, 0), 3, 3, 0)};
        if (wall) quads.push_back(ground(Vec3(0), 0.9f, 0.9f, 3));
        const Scene scene =
            scene_of(quads, {lambert(Rgb(0.5f)), lambert(Rgb(0.6f)), lambert(Rgb(0.7f)), lambert(Rgb(0.8f))});
        Renderer renderer(scene, nullptr);
        renderer.set_lighting(one_sun(Vec3(0.3f, 1, 0.2f), 1000.0f));
        FrameSettings frame = frame_of(from_above(2.0f), 40, 40);
        frame.cull = cull;
        const FrameReport report = renderer.draw(frame);
        return std::pair(report.objects_drawn, renderer.read_radiance().pixels);
    };
    const auto hidden = draw(true, true), all = draw(true, false), open = draw(false, true);
    EXPECT_EQ(all.first, 4);
    const std::string driver = context_->description();
    EXPECT_EQ(hidden.first, driver.find("llvmpipe") != std::string::npos ? 3 : 4) << driver;
    EXPECT_EQ(open.first, 3);
    EXPECT_EQ(hidden.second, all.second);
}

TEST_F(RendererTest, what_is_left_out_in_the_dark_does_not_change_the_picture_gl) {
    std::vector<Primitive> quads = {ground(Vec3(0, 4, 0), 3, 3, 0)};  // a roof over a floor of tiles
    for (int i = 0; i < 400; ++i)
        quads.push_back(ground({float(i % 20) - 9.5f, 0, float(i / 20) - 9.5f}, 0.5f, 0.5f, 0));
    const Scene scene = scene_of(quads, {lambert(Rgb(0.8f))});
    Renderer renderer(scene, nullptr);
    FrameSettings frame = frame_of(from_above(16.0f, Vec3(0), 3.0f), 128, 128);
    for (const Vec3& direction : {Vec3(0, 1, 0), Vec3(1, 2, 0.5f), Vec3(-2, 1, 1)}) {
        renderer.set_lighting(one_sun(direction, 1000.0f));
        frame.cull = true;
        const int parted = pass(renderer.draw(frame), "surfaces").draws;
        const Image a = renderer.read_radiance();
        frame.cull = false;
        EXPECT_GT(parted, pass(renderer.draw(frame), "surfaces").draws);  // lit tiles, dark tiles
        EXPECT_EQ(a.pixels, renderer.read_radiance().pixels);
    }
}

TEST_F(RendererTest, a_lamp_lights_what_is_smaller_than_its_maps_texels_gl) {
    // Tiles of 4 mm, each a material and so a cluster of its own; the lamp's texels span more than 10 mm here.
    std::vector<Primitive> quads = {ground(Vec3(0, -0.2f, 0), 4, 4, 0)};
    std::vector<Material> materials = {lambert(Rgb(0.0f))};
    for (int i = 0; i < 49; ++i) {
        quads.push_back(
            ground({float(i % 7) * 0.013f - 0.04f, 0, float(i / 7) * 0.017f - 0.05f}, 0.002f, 0.002f, i + 1));
        materials.push_back(lambert(Rgb(0.5f)));
    }
    Scene scene = scene_of(quads, materials);
    add_lamp(scene, {1.0f, 3.0f, 0.5f});
    Renderer renderer(scene, nullptr);
    renderer.set_lighting({{}, {Image(1, 1)}, {}});
    FrameSettings frame = frame_of(from_above(0.13f), 130, 130);
    renderer.draw(frame);
    const Image a = renderer.read_radiance();
    EXPECT_EQ(std::count_if(a.pixels.begin(), a.pixels.end(), [](const Rgb& p) { return p.g > 0.0f; }), 49 * 16);
    frame.cull = false;
    renderer.draw(frame);
    EXPECT_EQ(a.pixels, renderer.read_radiance().pixels);
}

TEST_F(RendererTest, a_still_sun_costs_nothing_gl) {
    Scene scene = scene_of({ground(Vec3(0), 50, 50, 0), ground(Vec3(0, 1, 0), 1, 1, 0)}, {lambert(Rgb(0.8f))});
    scene.nodes[1].dynamic = true;
    Renderer renderer(scene, nullptr);
    const auto shadows_ran = [&](const View& view) {
        return pass(renderer.draw(frame_of(view, 32, 32)), "sun shadows").ran;
    };
    renderer.set_lighting(one_sun({1, 2, 0.5f}, 1000.0f));
    EXPECT_TRUE(shadows_ran(look_at({0, 1.7f, 0}, {5, 1, 5}, 1.0f)));
    EXPECT_FALSE(shadows_ran(look_at({0, 1.7f, 0}, {5, 1, 5}, 1.0f)));
    EXPECT_FALSE(shadows_ran(look_at({0, 1.7f, 0}, {-5, 1, 2}, 1.0f)));  // turning the head
    renderer.set_lighting(one_sun({1, 2, 0.5f}, 1000.0f));
    renderer.set_pose(pose_scene(scene));
    EXPECT_FALSE(shadows_ran(look_at({0, 1.7f, 0}, {5, 1, 5}, 1.0f)));
    renderer.set_lighting(one_sun({1, 2.1f, 0.5f}, 1000.0f));
    EXPECT_TRUE(shadows_ran(look_at({0, 1.7f, 0}, {5, 1, 5}, 1.0f)));
    const NodeMove move{1, Vec3(1, 1, 0), 0.0f};
    renderer.set_pose(pose_scene(scene, 0.0, std::span(&move, 1)));
    EXPECT_TRUE(shadows_ran(look_at({0, 1.7f, 0}, {5, 1, 5}, 1.0f)));
    EXPECT_FALSE(shadows_ran(look_at({0, 1.7f, 0}, {5, 1, 5}, 1.0f)));
}

TEST_F(RendererTest, a_moved_node_is_drawn_where_it_is_gl) {
    Scene scene = scene_of({ground(Vec3(0), 0.5f, 0.5f, 0)}, {lambert(Rgb(0.8f))});
    scene.nodes[0].dynamic = true;
    Renderer renderer(scene, nullptr);
    const NodeMove move{0, Vec3(1, 0, 0), 0.0f};
    renderer.set_pose(pose_scene(scene, 0.0, std::span(&move, 1)));
    renderer.draw(frame_of(from_above(4.0f), 64, 64, Layer::Albedo));
    const Image image = renderer.read_radiance();
    EXPECT_NEAR(image.at(48, 32).g, 0.8f, 1e-5f);
    EXPECT_EQ(image.at(32 - 4, 32).g, 0.0f);
}

/// 512 * weight at 6:00 and 2048 * weight at 18:00, all over the four corners of a quad.
Baked constant_lightmap() {
    Baked baked;
    baked.lightmap.emplace();
    DayLightmap& map = *baked.lightmap;
    map.width = map.height = 4;
    map.basis.hours = {6.0, 18.0};
    map.basis.skies = 2, map.basis.sky_level = {1, 1};
    map.basis.components = 2;
    map.basis.curves = {1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};  // the first at 6, the second at 18
    map.tile_patterns = {2};
    map.scales = {1, 2};
    map.patterns = {1, 0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 1};
    map.values.assign(4 * 4, 512);
    map.values.insert(map.values.end(), 4 * 4, 1024);
    map.exponents.assign(4 * 4, 0);
    map.corner_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    return baked;
}

TEST_F(RendererTest, a_constant_lightmap_is_shown_exactly_gl) {
    const Scene scene = scene_of({ground(Vec3(0), 5, 5, 0)}, {lambert(Rgb(0.5f))});
    const Baked baked = constant_lightmap();
    Renderer renderer(scene, &baked);
    renderer.set_lighting({{}, {Image(1, 1)}, {.clear = 1.0f}});
    FrameSettings frame = frame_of(from_above(1.0f), 8, 8, Layer::Indirect);
    frame.hour = 12.0;
    EXPECT_TRUE(pass(renderer.draw(frame), "relight").ran);
    EXPECT_LT(relative(renderer.read_radiance().at(3, 3).g, 0.5 * 1280.0 / kPi), 1e-5);
    EXPECT_FALSE(pass(renderer.draw(frame), "relight").ran);
    renderer.set_lighting({{}, {Image(1, 1)}, {.clear = 0.5f}});
    EXPECT_TRUE(pass(renderer.draw(frame), "relight").ran);
    EXPECT_LT(relative(renderer.read_radiance().at(3, 3).g, 0.25 * 1280.0 / kPi), 1e-5);
    renderer.set_lighting({{}, {Image(1, 1)}, {.clear = 1.0f}});
    frame.hour = 18.0;
    frame.show = Layer::Lightmap;
    EXPECT_TRUE(pass(renderer.draw(frame), "relight").ran);
    EXPECT_LT(relative(renderer.read_radiance().at(3, 3).g, 2048.0), 1e-5);
}

/// A tile each for two quads: at 12:00 clear skies give 1280 and 2560 lux.
Baked lightmap_of_two_tiles() {
    Baked baked = constant_lightmap();
    DayLightmap& map = *baked.lightmap;
    const int side = DayLightmap::kTileSide;
    map.width = 2 * side, map.height = side;
    map.tile_patterns = {2, 2};
    map.scales = {1, 2, 2, 4};
    const std::vector<std::int16_t> patterns = map.patterns;
    map.patterns.insert(map.patterns.end(), patterns.begin(), patterns.end());
    map.values.assign(map.texels(), 512);
    map.values.insert(map.values.end(), map.texels(), 1024);
    map.exponents.assign(map.texels(), 0);
    map.corner_uvs.clear();
    for (const float tile : {0.0f, 1.0f}) {
        const float low = 0.5f * tile + 0.1f, high = 0.5f * tile + 0.4f;
        for (const Vec2& uv : {Vec2(low, 0), Vec2(high, 0), Vec2(high, 1), Vec2(low, 0), Vec2(high, 1), Vec2(low, 1)})
            map.corner_uvs.push_back(uv);
    }
    return baked;
}

TEST_F(RendererTest, only_tiles_in_view_are_relit_gl) {
    const Scene scene =
        scene_of({ground(Vec3(-6, 0, 0), 2, 2, 0), ground(Vec3(6, 0, 0), 2, 2, 0)}, {lambert(Rgb(0.5f))});
    const Baked baked = lightmap_of_two_tiles();
    Renderer renderer(scene, &baked);
    renderer.set_lighting({{}, {Image(1, 1)}, {.clear = 1.0f}});
    const View left = look_at({-6, 3, 0.1f}, {-6, 0, 0}, 0.5f), right = look_at({6, 3, 0.1f}, {6, 0, 0}, 0.5f);
    std::string why;
    const auto draw = [&](const View& view, double hour) {
        FrameSettings frame = frame_of(view, 8, 8, Layer::Lightmap);
        frame.hour = hour;
        const PassReport relight = pass(renderer.draw(frame), "relight");
        why = relight.why;
        return relight.triangles;
    };
    const auto shown = [&] { return renderer.read_radiance().at(3, 3).g; };
    EXPECT_EQ(draw(left, 12.0), 2);
    EXPECT_LT(relative(shown(), 1280.0), 1e-5);
    EXPECT_EQ(draw(left, 12.0), 0);
    EXPECT_EQ(draw(right, 12.0), 2);
    EXPECT_EQ(why, "surfaces came into view");
    EXPECT_LT(relative(shown(), 2560.0), 1e-5);
    EXPECT_EQ(draw(left, 12.0), 0);
    EXPECT_EQ(draw(left, 18.0), 2);
    EXPECT_EQ(draw(right, 18.0), 2);
    EXPECT_LT(relative(shown(), 4096.0), 1e-5);
    FrameSettings whole = frame_of(left, 8, 8, Layer::Lightmap);
    whole.hour = 12.0, whole.cull = false;
    EXPECT_EQ(pass(renderer.draw(whole), "relight").triangles, 4);
}

// All pixels of the normal map lean alike, so what is shown is what the look-up says. The veil below the ground makes
// frames blend, which must leave nothing that keeps the next hour from being relit.
TEST_F(RendererTest, normal_maps_respond_to_a_tilted_lightmap_gl) {
    Primitive quad = ground(Vec3(0), 5, 5, 0);
    quad.tangents.assign(4, Vec4(1, 0, 0, 1));
    Material veil = lambert(Rgb(0.5f));
    veil.alpha_mode = AlphaMode::Blend;
    veil.base_color.a = 0.5f;
    Scene scene = scene_of({std::move(quad), ground(Vec3(0, -1, 0), 1, 1, 1)}, {lambert(Rgb(0.5f)), veil});
    scene.images.push_back({1, 1, {178, 104, 230, 255}});
    scene.textures.push_back({.image = 0});
    scene.materials[0].normal_texture.texture = 0;
    Baked baked = constant_lightmap();
    DayLightmap& map = *baked.lightmap;
    map.corner_uvs.resize(12, Vec2(0.5f));  // the veil's too
    map.tile_tilted = {1};
    map.tilts.assign(4 * 16, 0);
    std::fill_n(map.tilts.begin(), 16, 100);        // pattern 0 along u
    std::fill_n(map.tilts.begin() + 48, 16, -200);  // pattern 1 along v
    Renderer renderer(scene, &baked);
    const LightScales scales{.clear = 1.0f};
    renderer.set_lighting({{}, {Image(1, 1)}, scales});
    // Shorter than 1, as where the filter averages several normals: the mean's own light, not that of a unit normal.
    const Vec3 mean = 2.0f * Vec3(178, 104, 230) / 255.0f - 1.0f;
    ASSERT_LT(glm::length(mean), 0.93f);
    const Vec3 sampled = 1.004f * mean;  // as material_normal() of shaders/material.glsl
    for (const double hour : {6.0, 12.0, 18.0}) {
        FrameSettings frame = frame_of(from_above(1.0f), 8, 8, Layer::Irradiance);
        frame.hour = hour;
        EXPECT_TRUE(pass(renderer.draw(frame), "blended").ran);
        const Rgb expected = map.irradiance(Vec2(0.5f), sampled, map.tile_light(map.basis.weights(scales, hour)));
        EXPECT_LT(relative(renderer.read_radiance().at(3, 3).g, expected.g), 2e-3) << hour;
        EXPECT_GT(relative(expected.g, map.irradiance(Vec2(0.5f), map.tile_light(map.basis.weights(scales, hour))).g),
                  0.04);
    }
}

TEST_F(RendererTest, sky_is_the_environment_and_the_sun_is_its_disc_gl) {
    const Scene scene = scene_of({ground(Vec3(0), 1, 1, 0)}, {lambert(Rgb(0.5f))});
    Renderer renderer(scene, nullptr);
    Lighting lighting = one_sun({0, 0.5f, -1}, 100000.0f);
    lighting.sky.map = Image(64, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) lighting.sky.map.at(x, y) = Rgb(float(x + 1), float(y + 1), 5.0f);
    renderer.set_lighting(lighting);
    const View view = look_at({0, 10, 0}, Vec3(0, 10, 0) + lighting.suns[0].direction, 0.02f);
    FrameSettings frame = frame_of(view, 101, 101);
    renderer.draw(frame);
    const Image image = renderer.read_radiance();
    EXPECT_LT(relative(image.at(50, 50).g, disc_radiance(lighting.suns[0]).g), 0.001);
    const ViewRay corner = view_ray(view, 0.5f, 0.5f, 101, 101);
    EXPECT_LT(relative(image.at(0, 0).g, lighting.sky.radiance(corner.direction).g), 0.001);
    EXPECT_LT(relative(image.at(0, 0).r, lighting.sky.radiance(corner.direction).r), 0.001);
    // All of the disc's light: E = sum of L * solid angle of a pixel.
    double lux = 0.0;
    const double pixel = std::pow(2.0 * std::tan(0.01) / 101.0, 2.0);
    for (const Rgb& p : image.pixels) lux += p.g > 1000.0f ? p.g * pixel : 0.0;
    EXPECT_NEAR(lux / 100000.0, 1.0, 0.02);
}

TEST_F(RendererTest, metering_on_the_gpu_agrees_with_auto_ev_gl) {
    const Scene scene = scene_of({ground(Vec3(0), 50, 50, 0), ground(Vec3(0, 2, -6), 5, 5, 1)},
                                 {lambert(Rgb(0.8f)), lambert(Rgb(0.1f))});
    Renderer renderer(scene, nullptr);
    Lighting lighting = one_sun({1, 1, -0.5f}, 80000.0f);
    lighting.sky.map = Image(1, 1, Rgb(4000.0f));
    renderer.set_lighting(lighting);
    FrameSettings frame = frame_of(look_at({0, 1.7f, 5}, {0, 1.5f, 0}, 1.0f), 640, 360);
    frame.ev.reset();
    const FrameReport report = renderer.draw(frame);
    EXPECT_NEAR(report.ev, auto_ev(renderer.read_radiance()), 0.1);
    const Image shown = renderer.read_display(), expected = tonemap(renderer.read_radiance(), report.ev);
    for (std::size_t i = 0; i < shown.pixels.size(); ++i)
        EXPECT_LT(glm::length(shown.pixels[i] - expected.pixels[i]), 1e-4f);
}

TEST(RendererContexts, egl_and_osmesa_show_the_same_gl) {
    const Scene scene = scene_of({ground(Vec3(0), 50, 50, 0), ground(Vec3(0, 2, -6), 5, 5, 1)},
                                 {lambert(Rgb(0.8f)), lambert(Rgb(0.1f))});
    const auto shown = [&](ContextKind kind) {
        const auto context = make_context(kind);
        Renderer renderer(scene, nullptr);
        renderer.set_lighting(one_sun({1, 1, -0.5f}, 80000.0f));
        renderer.draw(frame_of(look_at({0, 1.7f, 5}, {0, 1.5f, 0}, 1.0f), 320, 180));
        return renderer.read_display();
    };
    const Image egl = shown(ContextKind::Egl), osmesa = shown(ContextKind::OsMesa);
    for (std::size_t i = 0; i < egl.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_LE(std::abs(encode_srgb(egl.pixels[i][c]) - encode_srgb(osmesa.pixels[i][c])), 1.0f / 255.0f);
}

}  // namespace
}  // namespace daylit
