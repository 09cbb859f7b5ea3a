// The reference against numbers that can be derived on paper.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "engine/base/random.h"
#include "tests/physics/scenes.h"

namespace daylit {
namespace {

constexpr double kPercent = 0.01;

void expect_relative(const Rgb& got, const Rgb& wanted, double tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c] / wanted[c], 1.0, tolerance) << "channel " << c;
}

/// Every wall emits `emission` and reflects `albedo`.
void add_furnace(TestScene& test, const Rgb& albedo, const Rgb& emission) {
    test.box(test.add(lambert(albedo, emission)), Vec3(-1), Vec3(1));
}

TEST(Reference, ClosedFurnace) {
    // L = Le + albedo L everywhere, so L = Le / (1 - albedo) and E = pi L.
    const Rgb albedo(0.2f, 0.5f, 0.8f), emission(1.0f, 2.0f, 3.0f);
    TestScene test;
    add_furnace(test, albedo, emission);
    const Rgb radiance = emission / (1.0f - albedo);
    const Rgb e = irradiance_at(test.trace(), no_light(), {0.2f, -0.3f, 0.1f}, {0, 1, 0}, 1 << 20);
    expect_relative(e, kPi * glm::dvec3(radiance), 0.2 * kPercent);

    const View view = look_at({0.1f, 0.2f, 0.3f}, {1, 0, 0}, 1.5f);
    const PathTraceImage picture = path_trace(test.trace(), no_light(), {}, view, 16, 16, {.spp = 2048});
    expect_relative(mean(picture.radiance), radiance, 0.2 * kPercent);
}

TEST(Reference, BouncesAreCutWhereAsked) {
    // After n segments past the first surface: Le (1 - albedo^(n+1)) / (1 - albedo).
    TestScene test;
    add_furnace(test, Rgb(0.5f), Rgb(1.0f));
    const View view = look_at(Vec3(0), {1, 0, 0}, 1.0f);
    for (const int bounces : {0, 1, 2, 4}) {
        const PathTraceImage picture =
            path_trace(test.trace(), no_light(), {}, view, 8, 8, {.spp = 1024, .max_bounces = bounces});
        expect_relative(mean(picture.radiance), Rgb(2.0f * (1.0f - std::pow(0.5f, float(bounces + 1)))),
                        0.5 * kPercent);
    }
}

TEST(Reference, SunOnTiltedPlane) {
    // Lambert: L = albedo E cos / pi; the whole disc is above the plane, so the mean cosine is that of its middle.
    TestScene test;
    const Rgb albedo(0.3f, 0.6f, 0.9f), lux(90000.0f, 80000.0f, 70000.0f);
    const Vec3 normal = glm::normalize(Vec3(0.3f, 1.0f, -0.2f));
    const Vec3 u = glm::normalize(glm::cross(normal, Vec3(1, 0, 0))), v = glm::cross(normal, u);
    test.quad(test.add(lambert(albedo)), -5.0f * (u + v), 10.0f * u, 10.0f * v);
    for (const Vec3& direction : {Vec3(0, 1, 0), Vec3(1, 1, 1), Vec3(-1, 0.5f, 0.2f)}) {
        const Lighting light = one_sun(direction, lux);
        const float cosine = glm::dot(light.suns[0].direction, normal);
        const PathTraceImage picture = path_trace(test.trace(), light, {}, pinpoint(3.0f * normal, -normal + u * 0.1f),
                                                  4, 4, {.spp = 64, .layer = Layer::Direct});
        expect_relative(mean(picture.radiance), albedo * lux * cosine / float(kPi), 0.1 * kPercent);
    }
}

TEST(Reference, UniformSkyOnOpenPlane) {
    // E = pi L; with the plane's own albedo below the horizon seeing nothing, that is all.
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.8f))), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    const Rgb sky(1000.0f, 2000.0f, 4000.0f);
    const Rgb e = irradiance_at(test.trace(), constant_sky(sky), {0, 0, 0}, {0, 1, 0}, 1 << 14);
    expect_relative(e, kPi * glm::dvec3(sky), 0.2 * kPercent);
}

TEST(Reference, DoubledFacesDoNotShadowEachOther) {
    // Modellers leave walls that lie in each other, cut differently and turned either way. Where they tilt, rounding
    // puts each a little above the other in places; what leaves one must not be caught by the other.
    const Vec3 normal = glm::normalize(Vec3(0.3f, 1.0f, -0.2f));
    const Vec3 u = 10.0f * glm::normalize(glm::cross(normal, Vec3(1, 0, 0))), v = glm::cross(normal, u);
    const Vec3 corner(400.1f, 3.3f, -250.7f);  // far off, where floats are coarse
    TestScene test;
    const Rgb albedo(0.5f), sky(1000.0f), sun(30000.0f);
    const std::uint32_t wall = test.add(lambert(albedo));
    test.quad(wall, corner, u, v);
    test.quad(wall, corner + v, -v, u);
    for (int k = 0; k < 4; ++k) test.quad(wall, corner + 0.25f * float(k) * u, v, 0.25f * u);
    Lighting light = one_sun(Vec3(0, 1, 0.1f), sun);
    light.sky = constant_sky(sky).sky;
    const View view = look_at(corner + 0.5f * (u + v) + 4.0f * normal, corner + 0.45f * (u + v), 0.8f);
    const PathTraceImage picture = path_trace(test.trace(), light, {}, view, 32, 32, {.spp = 64});
    const float cosine = glm::dot(light.suns[0].direction, normal);
    expect_relative(mean(picture.radiance), albedo * (sun * cosine / float(kPi) + sky), 0.1 * kPercent);
}

TEST(Reference, SkyWithBrightSpot) {
    // A map that is dark but for a few texels, against its own quadrature: light sampling must find them.
    Image map(64, 32, Rgb(1.0f));
    for (int x = 10; x < 13; ++x) map.at(x, 9) = Rgb(50000.0f, 20000.0f, 0.0f);
    const Lighting light{.suns = {}, .sky = {map}};
    const Vec3 normal = glm::normalize(Vec3(-0.5f, 1.0f, 0.2f));
    glm::dvec3 expected(0.0);
    constexpr int kU = 1024, kV = 512;
    for (int j = 0; j < kV; ++j)
        for (int i = 0; i < kU; ++i) {
            const Vec3 d = direction_from_latlong(Vec2((i + 0.5f) / kU, (j + 0.5f) / kV));
            const double solid_angle = 2.0 * kPi / kU * kPi / kV * std::sin(kPi * (j + 0.5) / kV);
            expected += glm::dvec3(light.sky.radiance(d)) * double(std::max(glm::dot(d, normal), 0.0f)) * solid_angle;
        }
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.5f))), {90, 0, 0}, {1, 0, 0}, {0, 0, 1});  // far away: nothing in the sky
    const Rgb e = irradiance_at(test.trace(), light, {0, 0, 0}, normal, 1 << 17);
    expect_relative(e, expected, 0.5 * kPercent);
}

TEST(Reference, PointLampFollowsInverseSquares) {
    TestScene test;
    const Rgb albedo(0.5f);
    test.quad(test.add(lambert(albedo)), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    std::vector<PlacedLight> lamps(2);
    lamps[0].position = {0, 2, 0}, lamps[0].intensity = Rgb(100.0f, 50.0f, 0.5f);
    lamps[1].position = {3, 4, 0}, lamps[1].intensity = Rgb(0.5f, 50.0f, 100.0f);
    const PathTraceImage picture = path_trace(test.trace(), no_light(), lamps, pinpoint({0, 1, 1}, {0, -1, -1}), 8, 8,
                                              {.spp = 8192, .layer = Layer::Direct});
    const Rgb lux = lamps[0].intensity / 4.0f + lamps[1].intensity / 25.0f * (4.0f / 5.0f);
    expect_relative(mean(picture.radiance), albedo * lux / float(kPi), 1.5 * kPercent);
}

TEST(Reference, WhatIsLitInTheEveningFollowsTheDimmer) {
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.5f))), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    Material glow = lambert(Rgb(0.0f), Rgb(20.0f));
    glow.lit = Lit::Evening;
    test.quad(test.add(glow), {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
    std::vector<PlacedLight> lamps(1);
    lamps[0].position = {0, 1, 0}, lamps[0].intensity = Rgb(30.0f), lamps[0].lit = Lit::Evening;
    const std::vector<SurfaceSample> points(64, SurfaceSample{{0, 0, 0}, {0, 1, 0}});
    const auto light = [&](float evening, Layer layer) {
        Lighting lighting = no_light();
        lighting.scales.evening = evening;
        double sum = 0.0;
        for (const Rgb& e : path_trace_irradiance(test.trace(), lighting, lamps, points, {.spp = 64, .layer = layer}))
            sum += e.g / double(points.size());
        return sum;
    };
    for (const Layer layer : {Layer::Final, Layer::Indirect}) {  // the lamp and the glow; the glow alone
        const double full = light(1.0f, layer);
        EXPECT_GT(full, 5.0);
        EXPECT_NEAR(light(0.25f, layer) / full, 0.25, 1e-5);
        EXPECT_EQ(light(0.0f, layer), 0.0);
    }
    // Seen by the eye too.
    Lighting dusk = no_light();
    dusk.scales.evening = 0.25f;
    expect_relative(mean(path_trace(test.trace(), dusk, {}, pinpoint({0, 1, 0}, {0, 1, 0.1f}), 2, 2,
                                    {.spp = 4, .layer = Layer::Direct})
                             .radiance),
                    Rgb(5.0f), 0.001 * kPercent);
}

/// Mean of E / pi over the parallelogram that faces its cross(u, v): the form factor to what emits 1 cd/m^2.
double form_factor(const RayScene& rays, const Vec3& origin, const Vec3& u, const Vec3& v) {
    constexpr int kSide = 96;
    std::vector<SurfaceSample> points;
    const Vec3 normal = glm::normalize(glm::cross(u, v));
    Random random(7, 0, 0);
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const float a = (float(i) + random.next()) / kSide, b = (float(j) + random.next()) / kSide;
            points.push_back({origin + a * u + b * v, normal});
        }
    double sum = 0.0;
    for (const Rgb& e : path_trace_irradiance(rays, no_light(), {}, points, {.spp = 32})) sum += e.r;
    return sum / kPi / double(points.size());
}

TEST(Reference, FormFactorOfFacingRectangles) {
    // Howell C-11, identical a x b at distance c.
    const auto closed_form = [](double x, double y) {
        return 2.0 / (kPi * x * y) *
               (0.5 * std::log((1 + x * x) * (1 + y * y) / (1 + x * x + y * y)) +
                x * std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y)) +
                y * std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) - x * std::atan(x) - y * std::atan(y));
    };
    EXPECT_NEAR(closed_form(1, 1), 0.199824896, 1e-8);
    for (const auto& [a, b] : {std::pair(1.0f, 1.0f), std::pair(0.5f, 2.0f), std::pair(5.0f, 5.0f)}) {
        TestScene test;
        test.quad(test.add(lambert(Rgb(0.0f), Rgb(1.0f))), {0, 1, 0}, {a, 0, 0}, {0, 0, b});
        const double factor = form_factor(test.trace(), {0, 0, 0}, {0, 0, b}, {a, 0, 0});
        EXPECT_NEAR(factor / closed_form(a, b), 1.0, 0.3 * kPercent) << a << " x " << b;
    }
}

TEST(Reference, FormFactorOfPerpendicularRectangles) {
    // Howell C-14 with a common edge of length 1; values of its closed form.
    struct Case {
        float h, w;
        double factor;
    };
    const Case cases[] = {{1.0f, 1.0f, 0.200043776}, {0.1f, 0.1f, 0.281887807}, {0.1f, 1.0f, 0.043251369}};
    for (const Case& c : cases) {
        TestScene test;
        test.quad(test.add(lambert(Rgb(0.0f), Rgb(1.0f))), {0, 0, 0}, {0, 0, 1}, {0, c.h, 0});
        const double factor = form_factor(test.trace(), {0, 0, 0}, {0, 0, 1}, {c.w, 0, 0});
        EXPECT_NEAR(factor / c.factor, 1.0, 0.3 * kPercent) << c.h << " on " << c.w;
    }
}

TEST(Reference, MeansOverSeedsAgreeWithTheStatedError) {
    // Sum over pixels and seeds of (mean - grand mean)^2 / (stated error)^2 is chi-square distributed.
    TestScene test;
    test.box(test.add(lambert(Rgb(0.5f))), Vec3(-1), Vec3(1));
    test.quad(test.add(lambert(Rgb(0.0f), Rgb(10.0f))), {-0.5f, 0.9f, -0.5f}, {1, 0, 0}, {0, 0, 1});
    const View view = look_at({-0.8f, 0.0f, 0.0f}, {1, -0.3f, 0}, 1.2f);
    constexpr int kSeeds = 48, kSide = 6;
    std::vector<PathTraceImage> pictures;
    for (int seed = 0; seed < kSeeds; ++seed)
        pictures.push_back(path_trace(test.trace(), no_light(), {}, view, kSide, kSide,
                                      {.spp = 128, .seed = std::uint64_t(seed)}));
    double chi_square = 0.0;
    for (std::size_t i = 0; i < kSide * kSide; ++i) {
        double sum = 0.0, variance = 0.0;
        for (const PathTraceImage& p : pictures) {
            sum += p.radiance.pixels[i].g / kSeeds;
            variance += std::pow(p.standard_error.pixels[i].g, 2.0) / kSeeds;
        }
        for (const PathTraceImage& p : pictures) chi_square += std::pow(p.radiance.pixels[i].g - sum, 2.0) / variance;
    }
    const double freedom = kSide * kSide * (kSeeds - 1);
    EXPECT_NEAR(chi_square, freedom, 4.0 * std::sqrt(2.0 * freedom));
}

TEST(Reference, StopsAtTheAskedError) {
    TestScene test;
    test.box(test.add(lambert(Rgb(0.5f))), Vec3(-1), Vec3(1));
    test.quad(test.add(lambert(Rgb(0.0f), Rgb(10.0f))), {-0.5f, 0.9f, -0.5f}, {1, 0, 0}, {0, 0, 1});
    const View view = look_at({-0.8f, 0.0f, 0.0f}, {1, -0.3f, 0}, 1.2f);
    const PathTraceImage picture =
        path_trace(test.trace(), no_light(), {}, view, 8, 8, {.spp = 16, .error = 0.02});
    EXPECT_LE(picture.relative_error, 0.02);
    EXPECT_GT(picture.relative_error, 0.01);
    EXPECT_GT(picture.spp, 16);
    const PathTraceImage capped =
        path_trace(test.trace(), no_light(), {}, view, 8, 8, {.spp = 16, .error = 1e-6, .max_spp = 40});
    EXPECT_EQ(capped.spp, 40);
}

TEST(Reference, SameBytesForAnyNumberOfThreads) {
    TestScene test;
    test.box(test.add(lambert(Rgb(0.7f))), Vec3(-1), Vec3(1));
    test.quad(test.add(lambert(Rgb(0.2f), Rgb(10.0f))), {-0.5f, 0.9f, -0.5f}, {1, 0, 0}, {0, 0, 1});
    Material veil = lambert(Rgb(0.9f));
    veil.base_color.a = 0.4f;
    veil.alpha_mode = AlphaMode::Blend;
    test.quad(test.add(veil), {-0.5f, -0.5f, -0.9f}, {0, 1, 0}, {0, 0, 1.8f});
    const View view = look_at({-0.8f, 0.0f, 0.0f}, {1, -0.3f, 0}, 1.2f);
    const auto with_threads = [&](int threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
        PathTraceImage picture;
        tbb::task_arena(threads).execute([&] {
            const RayScene rays(test.scene, test.mesh);
            picture = path_trace(rays, no_light(), {}, view, 40, 24, {.spp = 8});
        });
        return picture;
    };
    const PathTraceImage one = with_threads(1), many = with_threads(5);
    EXPECT_EQ(one.radiance.pixels, many.radiance.pixels);
    EXPECT_EQ(one.standard_error.pixels, many.standard_error.pixels);
    EXPECT_EQ(one.rays, many.rays);
}

TEST(Reference, CancelledWorkThrowsInterrupted) {
    TestScene test;
    add_furnace(test, Rgb(0.5f), Rgb(1.0f));
    const View view = look_at(Vec3(0), {1, 0, 0}, 1.0f);
    EXPECT_THROW(path_trace(test.trace(), no_light(), {}, view, 64, 64, {.spp = 64}, [](double) { return false; }),
                 Interrupted);
    const std::vector<SurfaceSample> points(100, SurfaceSample{Vec3(0), Vec3(0, 1, 0)});
    EXPECT_THROW(path_trace_irradiance(test.trace(), no_light(), {}, points, {.spp = 4}, [](double) { return false; }),
                 Interrupted);
}

TEST(Reference, SunDiscIsSeenWithItsRadiance) {
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.5f))), {90, 0, 0}, {1, 0, 0}, {0, 0, 1});
    const Rgb lux(90000.0f);
    const Lighting light = one_sun({0.3f, 0.6f, 0.74f}, lux);
    const Vec3 d = light.suns[0].direction;
    const double sine = std::sin(0.2665 * kDegree);
    const auto seen = [&](const Vec3& at) {
        return mean(path_trace(test.trace(), light, {}, look_at(Vec3(0), at, 0.001f), 4, 4,
                               {.spp = 4, .layer = Layer::Direct})
                        .radiance);
    };
    expect_relative(seen(d), glm::dvec3(lux) / (kPi * sine * sine), 1e-4);
    EXPECT_EQ(seen(glm::normalize(d + Vec3(0.01f, 0, 0))), Rgb(0.0f));
}

TEST(Reference, IndirectLeavesTheSunOutAndFinalIsTheSum) {
    TestScene test;
    test.quad(test.add(lambert(Rgb(0.5f))), {-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
    Lighting light = one_sun({0, 1, 0}, Rgb(float(kPi) * 200.0f));
    light.sky = constant_sky(Rgb(7.0f)).sky;
    const View view = pinpoint({0, 1, 0.3f}, {0, -1, -0.3f});
    const auto layer = [&](Layer which) {
        return mean(path_trace(test.trace(), light, {}, view, 8, 8, {.spp = 64, .layer = which}).radiance);
    };
    expect_relative(layer(Layer::Direct), Rgb(100.0f), 1e-3);
    expect_relative(layer(Layer::Indirect), Rgb(3.5f), 1e-3);
    expect_relative(layer(Layer::Final), Rgb(103.5f), 1e-3);
    expect_relative(layer(Layer::Irradiance), Rgb(float(kPi) * 207.0f), 1e-2);
    expect_relative(layer(Layer::Albedo), Rgb(0.5f), 1e-6);
    expect_relative(layer(Layer::Normal), Rgb(0.5f, 1.0f, 0.5f), 1e-6);
    expect_relative(layer(Layer::Depth), Rgb(std::sqrt(1.09f)), 1e-3);
    const std::vector<SurfaceSample> point = {{Vec3(0), Vec3(0, 1, 0)}};
    expect_relative(path_trace_irradiance(test.trace(), light, {}, point, {.spp = 256, .layer = Layer::Indirect})[0],
                    Rgb(float(kPi) * 7.0f), 1e-3);
}

}  // namespace
}  // namespace daylit
