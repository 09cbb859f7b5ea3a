// How the reference treats coverage, glass, mirrors and textured emitters, on paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "gi/surface/atlas.h"
#include "gi/surface/texels.h"
#include "gi/transport/day_gather/sight.h"
#include "gi/transport/path_trace/bsdf.h"
#include "gi/transport/path_trace/materials.h"
#include "tests/physics/scenes.h"

namespace daylit {
namespace {

void expect_relative(const Rgb& got, const Rgb& wanted, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c] / wanted[c], 1.0, tolerance) << "channel " << c;
}

/// Two texels side by side, from v = 0 to 1.
Image8 two_texels(std::array<std::uint8_t, 4> left, std::array<std::uint8_t, 4> right) {
    return {2, 1, {left[0], left[1], left[2], left[3], right[0], right[1], right[2], right[3]}};
}

Material veil(float alpha, const Rgb& albedo, const Rgb& emission) {
    Material m = lambert(albedo, emission);
    m.base_color.a = alpha;
    m.alpha_mode = AlphaMode::Blend;
    return m;
}

TEST(Coverage, BlendShadesBySunAndIsSeenThrough) {
    // Two black veils over a floor: the sun's 1000 lux fall to 1000 (1 - 0.25)(1 - 0.5).
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.5f))), {-9, 0, 9}, {18, 0, 0}, {0, 0, -18});
    test.quad(test.add(veil(0.25f, Rgb(0.0f), Rgb(0.0f))), {-9, 1, 9}, {18, 0, 0}, {0, 0, -18});
    test.quad(test.add(veil(0.5f, Rgb(0.0f), Rgb(0.0f))), {-9, 2, 9}, {18, 0, 0}, {0, 0, -18});
    const Lighting light = one_sun({0.2f, 1, 0}, Rgb(1000.0f));
    const float cosine = light.suns[0].direction.y;
    const PathTraceImage below = path_trace(test.trace(), light, {}, pinpoint({0.3f, 0.5f, 0.1f}, {0, -1, -0.1f}), 4, 4,
                                            {.spp = 16, .layer = Layer::Direct});
    const float lit = 0.5f * 1000.0f * cosine * 0.375f / float(kPi);
    expect_relative(mean(below.radiance), Rgb(lit), 1e-3);
    const PathTraceImage above = path_trace(test.trace(), light, {}, pinpoint({0.3f, 3, 0.1f}, {0, -1, -0.1f}), 16, 16,
                                            {.spp = 512, .layer = Layer::Direct});
    expect_relative(mean(above.radiance), Rgb(lit * 0.375f), 0.02);
}

TEST(Coverage, VeilInAFurnaceIsInvisible) {
    // alpha (Le + rho L) + (1 - alpha) L = L when L = Le / (1 - rho).
    TestScene test;
    test.box(test.add(lambert(Rgb(0.5f), Rgb(1.0f))), Vec3(-1), Vec3(1));
    test.quad(test.add(veil(0.3f, Rgb(0.5f), Rgb(1.0f))), {-1, -0.2f, 1}, {2, 0, 0}, {0, 0.1f, -2});
    const PathTraceImage picture = path_trace(test.trace(), no_light(), {}, look_at({0, 0.8f, 0}, {0.3f, -1, 0}, 1.5f),
                                              16, 16, {.spp = 1024});
    expect_relative(mean(picture.radiance), Rgb(2.0f), 2e-3);
}

TEST(Coverage, MaskCutsWhereTheTextureSays) {
    // The left half of the sheet is cut away: the sun reaches the left half of the floor.
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.5f))), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    Material leaf = lambert(Rgb(0.0f));
    leaf.alpha_mode = AlphaMode::Mask;
    leaf.base_color_texture = test.add_texture(two_texels({255, 255, 255, 20}, {255, 255, 255, 230}));
    test.quad(test.add(leaf), {-1, 0.5f, 1}, {2, 0, 0}, {0, 0, -2});
    const Lighting light = one_sun({0, 1, 0}, Rgb(float(kPi) * 100.0f));
    const auto floor_at = [&](float x) {
        return mean(path_trace(test.trace(), light, {}, pinpoint({x, 0.25f, 0}, {0, -1, 0.01f}), 2, 2,
                               {.spp = 4, .layer = Layer::Direct})
                        .radiance)
            .r;
    };
    EXPECT_NEAR(floor_at(-0.5f), 50.0f, 0.1f);
    EXPECT_EQ(floor_at(0.5f), 0.0f);
}

TEST(Faces, CullingIsForTheCameraOnly) {
    // A single-sided roof seen from below is not there for the eye, yet it shades the floor.
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.5f))), {-9, 0, 9}, {18, 0, 0}, {0, 0, -18});
    Material roof = lambert(Rgb(0.5f), Rgb(3.0f));
    roof.double_sided = false;
    test.quad(test.add(roof), {-9, 2, 9}, {18, 0, 0}, {0, 0, -18});  // its front is up
    Lighting light = one_sun({0, 1, 0}, Rgb(1000.0f));
    light.sky = constant_sky(Rgb(5.0f)).sky;
    const auto seen = [&](const Vec3& eye, const Vec3& way) {
        return mean(path_trace(test.trace(), light, {}, pinpoint(eye, way), 2, 2, {.spp = 16, .layer = Layer::Direct})
                        .radiance)
            .r;
    };
    EXPECT_EQ(seen({0, 1, 0}, {0.1f, 1, 0.1f}), 5.0f);   // the sky through it
    EXPECT_EQ(seen({0, 1, 0}, {0.1f, -1, 0.1f}), 0.0f);  // the floor in its shadow
    EXPECT_NEAR(seen({0, 3, 0}, {0.1f, -1, 0.1f}), 3.0f + 500.0f / float(kPi), 0.5f);
}

TEST(Glass, SnellAndFresnel) {
    // 45 degrees into ior 1.5: sin = 0.4714; normal incidence reflects ((n - 1) / (n + 1))^2.
    const Vec3 incoming = glm::normalize(Vec3(1, -1, 0));
    const GlassBounce in = sample_glass(incoming, {0, 1, 0}, 1.5f, 0.999f);
    EXPECT_TRUE(in.transmitted);
    EXPECT_NEAR(in.direction.x, std::sqrt(0.5f) / 1.5f, 1e-6f);
    EXPECT_NEAR(glm::length(in.direction), 1.0f, 1e-6f);
    EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(fresnel_dielectric(1.0f, 1.0f / 1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(fresnel_dielectric(std::sqrt(0.5f), 1.5f), 0.0502f, 1e-4f);  // 1/2 (0.0920 + 0.0085), Hecht
    EXPECT_EQ(fresnel_dielectric(0.5f, 1.0f / 1.5f), 1.0f);
}

TEST(Glass, WhiteGlassInAFurnaceIsInvisible) {
    for (const bool pane : {false, true}) {
        TestScene test;
        test.box(test.add(lambert(Rgb(0.5f), Rgb(1.0f))), Vec3(-1), Vec3(1));
        const std::uint32_t clear = test.add(glass(1.5f));
        if (pane)
            test.quad(clear, {-0.5f, -0.1f, 0.5f}, {1, 0, 0}, {0, 0.1f, -1});
        else
            test.box(clear, {-0.5f, -0.2f, -0.5f}, {0.5f, 0.1f, 0.5f});
        const View view = look_at({0.1f, 0.8f, 0.2f}, {0, 0, 0}, 1.5f);
        const PathTraceImage picture = path_trace(test.trace(), no_light(), {}, view, 16, 16, {.spp = 1024});
        expect_relative(mean(picture.radiance), Rgb(2.0f), 2e-3);
    }
}

TEST(Glass, BodyAndPaneLetTheSameThrough) {
    // Straight through: tint (1 - R) / (1 + R) with R = 0.04, for a slab as for a sheet; nothing to mirror behind the
    // eye. It is direct light: the camera sees it.
    const Rgb tint(0.9f, 0.5f, 0.2f);
    for (const bool pane : {false, true}) {
        TestScene test;
        test.quad(test.add(lambert(Rgb(0.0f), Rgb(10.0f))), {-5, -1, 5}, {10, 0, 0}, {0, 0, -10});
        const std::uint32_t tinted = test.add(glass(1.5f, tint));
        if (pane)
            test.quad(tinted, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
        else
            test.box(tinted, {-1, -0.2f, -1}, {1, 0.1f, 1});
        const PathTraceImage picture = path_trace(test.trace(), no_light(), {},
                                                  look_at({0, 1, 0.001f}, {0, 0, 0}, 1e-3f), 16, 16,
                                                  {.spp = 1024, .layer = Layer::Direct});
        // Direct leaves out what bounced inside the slab: (1 - R)^2 rather than (1 - R) / (1 + R).
        const float share = pane ? 0.96f / 1.04f : 0.96f * 0.96f;
        expect_relative(mean(picture.radiance), 10.0f * tint * share, 3e-3);
    }
}

/// Of a picture and its mean's own standard error: pixels are independent.
struct Measured {
    Rgb mean, error;
};
Measured measured(const PathTraceImage& picture) {
    glm::dvec3 squares(0.0);
    for (const Rgb& e : picture.standard_error.pixels) squares += glm::dvec3(e) * glm::dvec3(e);
    return {mean(picture.radiance), Rgb(glm::sqrt(squares) / double(picture.standard_error.pixels.size()))};
}

/// A sheet of this material over a black floor that shines with 10, under a sky of 4; seen from above at x.
PathTraceImage sheet_seen_at(TestScene& test, const Material& material, float x) {
    test.quad(test.add(lambert(Rgb(0.0f), Rgb(10.0f))), {-5, -1, 5}, {10, 0, 0}, {0, 0, -10});
    test.quad(test.add(material), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    return path_trace(test.trace(), constant_sky(Rgb(4.0f)), {}, pinpoint({x, 1, 0.1f}, {0, -1, 0.001f}), 16, 16,
                      {.spp = 1024});
}

TEST(Glass, ShareOfItIsMetByThatChance) {
    // A pane lets tint (1 - R) / (1 + R) through and mirrors 2 R / (1 + R), R = 0.04; the rest is a Lambert surface
    // under an open sky.
    const Rgb tint(0.9f, 0.5f, 0.2f);
    const auto light = [&](float share) {
        return share * (10.0f * tint * (0.96f / 1.04f) + 4.0f * (0.08f / 1.04f)) + (1.0f - share) * 4.0f * tint;
    };
    const auto expect = [&](float factor, bool textured, float x, float share) {
        TestScene test;
        Material material = glass(1.5f, tint);
        material.transmission = factor;
        if (textured) material.transmission_texture = test.add_texture(two_texels({255, 0, 0, 0}, {0, 255, 255, 255}));
        const Measured got = measured(sheet_seen_at(test, material, x));
        for (int c = 0; c < 3; ++c) {
            EXPECT_LT(got.error[c], 0.02f);
            EXPECT_NEAR(got.mean[c], light(share)[c], 4.0f * got.error[c] + 1e-4f) << factor << " at " << x;
        }
    };
    expect(0.5f, false, 0.5f, 0.5f);
    expect(0.5f, true, -0.5f, 0.5f);
    expect(0.5f, true, 0.5f, 0.0f);
    expect(1.0f, true, -0.5f, 1.0f);
    expect(1.0f, true, 0.5f, 0.0f);
}

TEST(Glass, WholeOrNoneTakesNoRandomNumber) {
    // So scenes whose glass is glass all over give the same pictures as ever, to the bit.
    struct Refused {
        float next() {
            ADD_FAILURE() << "a number was drawn";
            return 0.5f;
        }
    } random;
    TestScene test;
    Material half = glass(1.5f);
    half.transmission_texture = test.add_texture(two_texels({255, 0, 0, 0}, {0, 255, 255, 255}));
    const std::uint32_t opaque = test.add(lambert(Rgb(0.5f))), whole = test.add(glass(1.5f)), varied = test.add(half);
    const Materials materials(test.scene);
    const auto meets = [&](std::uint32_t material, float u) {
        SurfacePoint point{};
        point.material = material;
        point.uvs[0] = Vec2(u, 0.5f);
        return materials.meets_glass(point, random);
    };
    EXPECT_FALSE(meets(opaque, 0.25f));
    EXPECT_TRUE(meets(whole, 0.25f));
    EXPECT_TRUE(meets(varied, 0.25f));
    EXPECT_FALSE(meets(varied, 0.75f));
}

TEST(Glass, GatherRaysMeetItByThatChance) {
    // Clear glass of ior 1: rays that go on are those that met glass.
    TestScene test;
    Material material = glass(1.0f);
    material.transmission = 0.5f;
    material.transmission_texture = test.add_texture(two_texels({255, 0, 0, 255}, {128, 0, 0, 255}));
    test.quad(test.add(material), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    const Atlas atlas = make_atlas(test.mesh, 100);
    const Texels texels = make_texels(test.mesh, atlas);
    const GatherScene scene = gather_scene(test.trace(), atlas, texels, {});
    const Sight sight(scene);
    for (const float x : {-0.5f, 0.5f}) {
        constexpr int kRays = 1 << 16;
        Random random(1, 2, 3);
        int passed = 0;
        for (int i = 0; i < kRays; ++i) {
            Ray ray{{x, 1, 0.1f}, {0, -1, 0}};
            passed += !sight.past_glass(ray, random);
        }
        const double share = x < 0 ? 0.5 : 0.5 * 128 / 255;
        EXPECT_NEAR(passed / double(kRays), share, 4.0 * std::sqrt(share * (1.0 - share) / kRays)) << x;
    }
}

TEST(Coat, TexturesOfItAreSeenByPaths) {
    // The albedo layer is the shared BRDF's; black without the textures' right UVs.
    TestScene test;
    Material material = lambert(Rgb(0.0f));
    material.specular = 0.5f;
    material.specular_color = Rgb(20.0f);
    for (const bool colour : {false, true}) {
        Material coat = material;
        (colour ? coat.specular_color_texture : coat.specular_texture) =
            test.add_texture(two_texels({0, 0, 0, 0}, {255, 188, 0, 51}));
        test.quad(test.add(coat), {-1, colour ? 0.0f : -1.0f, 1}, {2, 0, 0}, {0, 0, -2});
    }
    const auto albedo = [&](float x, float y) {
        return mean(path_trace(test.trace(), no_light(), {}, pinpoint({x, y + 0.5f, 0.1f}, {0, -1, 0.01f}), 2, 2,
                               {.spp = 4, .layer = Layer::Albedo})
                        .radiance);
    };
    EXPECT_EQ(albedo(-0.5f, 0), Rgb(0));
    EXPECT_EQ(albedo(-0.5f, -1), Rgb(0));
    const Rgb colour = albedo(0.5f, 0), strength = albedo(0.5f, -1);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(colour[c], 0.5f * 0.8f * Rgb(1, 0.502886f, 0)[c], 1e-5f);
        EXPECT_NEAR(strength[c], 0.5f * 0.2f * 0.8f, 1e-5f);
    }
}

TEST(Coat, RoughestIsThatOfLambertInAllDirections) {
    // Light from where the view is: more than a right angle off the mirrored view.
    const glsl::Brdf brdf{.diffuse = Rgb(0.3f), .specular = Rgb(0.2f), .exponent = 0.0f};
    const Vec3 up(0, 1, 0), low = glm::normalize(Vec3(1, 0.2f, 0));
    const Reflection surface(brdf, up, up, low);
    const Rgb expected = glsl::evaluate_brdf(brdf, glm::dot(glm::reflect(-low, up), low)) * low.y;
    EXPECT_NEAR(expected.r, 0.5f * low.y / float(kPi), 1e-6f);
    EXPECT_NEAR(surface.evaluate_with_pdf(low).f_cos.r, expected.r, 1e-6f);
}

TEST(Mirror, ReflectsTheSkyByTheSharedBrdf) {
    // A lobe much narrower than the sky's features: L = albedo (n + 2) / (n + 1) cos(theta) L_sky, never more.
    TestScene test;
    const Rgb albedo(0.9f, 0.6f, 0.3f);
    test.quad(test.add(mirror(albedo)), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    for (const float angle : {0.0f, 0.5f, 1.0f}) {
        const Vec3 eye(std::sin(angle), std::cos(angle), 0.001f);
        const PathTraceImage picture =
            path_trace(test.trace(), constant_sky(Rgb(10.0f)), {}, pinpoint(eye, -eye), 8, 8, {.spp = 64});
        expect_relative(mean(picture.radiance), 10.0f * albedo * std::cos(angle), 3e-3);
    }
}

TEST(Mirror, FurnaceStaysInBounds) {
    TestScene test;
    Material walls = mirror(Rgb(0.9f));
    walls.emission = Rgb(1.0f);
    test.box(test.add(walls), Vec3(-1), Vec3(1));
    const PathTraceImage picture =
        path_trace(test.trace(), no_light(), {}, look_at(Vec3(0), {1, 0.2f, 0.3f}, 1.5f), 16, 16, {.spp = 256});
    for (const Rgb& p : picture.radiance.pixels) {
        EXPECT_GT(p.r, 1.0f);
        EXPECT_LT(p.r, 10.0f * 1.01f);
    }
}

TEST(Mirror, SunInALobeAsWideAsItsDisc) {
    // Looking along the mirrored sun: albedo (n + 2) / (n + 1) (1 - cos(r)^(n + 1)) cos(theta) L_sun. Here neither the
    // light's sampling nor the lobe's is good alone.
    TestScene test;
    test.quad(test.add(mirror(Rgb(0.8f))), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    const Lighting light = one_sun({0.5f, 1, 0}, Rgb(1000.0f));
    const Vec3 sun = light.suns[0].direction, eye(-sun.x, sun.y, sun.z);
    const double n = double(glsl::kMaxPhongExponent), radius = 0.2665 * kDegree;
    const double share = (n + 2) / (n + 1) * -std::expm1((n + 1) * std::log1p(-2 * std::pow(std::sin(radius / 2), 2)));
    const double expected = 0.8 * share * double(sun.y) * double(disc_radiance(light.suns[0]).r);
    const View view = look_at(3.0f * eye, Vec3(0), 1e-5f);
    const PathTraceImage picture =
        path_trace(test.trace(), light, {}, view, 16, 16, {.spp = 1024, .layer = Layer::Direct});
    EXPECT_NEAR(mean(picture.radiance).r / expected, 1.0, 0.01);
}

TEST(Emission, TexturedEmitterLightsByItsBrightHalf) {
    // Over the corner of the bright half, 1 x 1 at height 1 (Howell, element to parallel rectangle).
    TestScene test;
    Material lamp = lambert(Rgb(0.0f), Rgb(100.0f));
    lamp.emission_texture = test.add_texture(two_texels({0, 0, 0, 255}, {255, 255, 255, 255}));
    test.quad(test.add(lamp), {-1, 1, 0}, {2, 0, 0}, {0, 0, 1});
    const Rgb e = irradiance_at(test.trace(), no_light(), {0, 0, 0}, {0, 1, 0}, 1 << 18);
    const double factor = std::atan(1.0 / std::sqrt(2.0)) / std::sqrt(2.0) / kPi;
    EXPECT_NEAR(factor, 0.138532, 1e-6);
    expect_relative(e, Rgb(float(100.0 * kPi * factor)), 5e-3);
}

TEST(Emission, UnlitShowsItsColourAndReflectsNothing) {
    TestScene test;
    Material sign = lambert(Rgb(0.3f, 0.6f, 0.9f));
    sign.unlit = true;
    test.quad(test.add(sign), {-9, 0, 9}, {18, 0, 0}, {0, 0, -18});
    const PathTraceImage picture = path_trace(test.trace(), one_sun({0, 1, 0}, Rgb(1000.0f)), {},
                                              pinpoint({0, 1, 0.1f}, {0, -1, -0.1f}), 2, 2, {.spp = 4});
    expect_relative(mean(picture.radiance), {0.3f, 0.6f, 0.9f}, 1e-5);
}

TEST(Emission, SquareAreaLight) {
    const std::string path = std::string(DAYLIT_SHARED_DIR) + "/reference/lighting/square-area-light.csv";
    std::ifstream file(path);
    if (!file) GTEST_SKIP() << path << " is missing";
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.0f), Rgb(1.0f))), {-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1});
    int rows = 0;
    for (std::string line; std::getline(file, line);) {
        float v[7];
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream in(line);
        for (float& value : v) in >> value;
        if (!in) continue;
        ++rows;
        const Rgb e = irradiance_at(test.trace(), no_light(), {v[0], v[1], v[2]}, {v[3], v[4], v[5]}, 1 << 16);
        EXPECT_NEAR(e.r / v[6], 1.0, 0.005) << line;
    }
    EXPECT_GE(rows, 10);
}

}  // namespace
}  // namespace daylit
