// How the reference treats coverage, glass, mirrors and textured emitters, on paper.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "gi/transport/path_trace/bsdf.h"
#include "tests/physics/scenes.h"

namespace daylit {
namespace {

void expect_relative(const Rgb& got, const Rgb& wanted, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c] / wanted[c], 1.0, tolerance) << "channel " << c;
}

/// Two texels side by side, from v = 0 to 1.
Image8 two_texels(std::array<std::uint8_t, 4> left, std::array<std::uint8_t, 4> right) {
    Image8 image{2, 1, {}};
    image.rgba.insert(image.rgba.end(), left.begin(), left.end());
    image.rgba.insert(image.rgba.end(), right.begin(), right.end());
    return image;
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
