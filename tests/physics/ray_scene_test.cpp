// The door to Embree: hits, coverage and what is left out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/random.h"
#include "tests/physics/scenes.h"

namespace daylit {
namespace {

constexpr Vec3 kDown(0, -1, 0);

void add_sheet(TestScene& test, std::uint32_t material, float height) {
    test.quad(material, {-1, height, 1}, {2, 0, 0}, {0, 0, -2});
}

TEST(RayScene, NearestSurfaceAndItsNormal) {
    TestScene test;
    const std::uint32_t white = test.add(lambert(Rgb(1.0f)));
    add_sheet(test, white, 0.0f);
    add_sheet(test, white, 1.0f);
    const Ray ray{{0.25f, 3, 0.5f}, kDown};
    const auto hit = test.trace().closest(ray, 1);
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 2.0f);
    EXPECT_GE(hit->triangle, 2u);
    EXPECT_EQ(hit->normal, Vec3(0, 1, 0));
    const SurfacePoint point = test.trace().surface_point(ray, *hit);
    EXPECT_NEAR(glm::distance(point.position, Vec3(0.25f, 1, 0.5f)), 0.0f, 1e-6f);
    EXPECT_FALSE(test.trace().closest({{0.25f, 3, 0.5f}, -kDown}, 1));
    EXPECT_FALSE(test.trace().closest({{0.25f, 3, 0.5f}, kDown, 0.0f, 1.5f}, 1));
    // From below, both normals turn to the ray's side.
    const Ray up{{0.25f, 0.5f, 0.5f}, -kDown};
    const SurfacePoint under = test.trace().surface_point(up, *test.trace().closest(up, 1));
    EXPECT_EQ(under.geometric_normal, Vec3(0, -1, 0));
    EXPECT_EQ(under.shading_normal, Vec3(0, -1, 0));
}

TEST(RayScene, BlendIsPassedByItsShare) {
    TestScene test;
    Material veil = lambert(Rgb(1.0f));
    veil.base_color.a = 0.3f;
    veil.alpha_mode = AlphaMode::Blend;
    add_sheet(test, test.add(veil), 1.0f);
    const RayScene& rays = test.trace();
    const Ray ray{{0.25f, 3, 0.5f}, kDown};
    int hits = 0;
    constexpr int kRays = 20000;
    for (std::uint64_t key = 0; key < kRays; ++key) hits += rays.closest(ray, key).has_value();
    EXPECT_NEAR(hits, 0.3 * kRays, 5.0 * std::sqrt(0.21 * kRays));
    EXPECT_EQ(rays.closest(ray, 5).has_value(), rays.closest(ray, 5).has_value());
    EXPECT_FLOAT_EQ(rays.transmittance(ray), 0.7f);
}

TEST(RayScene, TransmittanceIsAProductAndEndsAtItsTarget) {
    TestScene test;
    Material veil = lambert(Rgb(1.0f));
    veil.alpha_mode = AlphaMode::Blend;
    veil.base_color.a = 0.5f;
    const std::uint32_t half = test.add(veil), wall = test.add(lambert(Rgb(1.0f)));
    for (const float height : {1.0f, 1.5f, 2.0f}) add_sheet(test, half, height);
    add_sheet(test, wall, 0.5f);
    const RayScene& rays = test.trace();
    EXPECT_FLOAT_EQ(rays.transmittance({{0.2f, 3, 0.5f}, kDown, 0.0f, 2.2f}), 0.125f);
    EXPECT_EQ(rays.transmittance({{0.2f, 3, 0.5f}, kDown}), 0.0f);
    EXPECT_EQ(rays.transmittance({{0.2f, 3, 0.5f}, -kDown}), 1.0f);
}

TEST(RayScene, GlassBlocksTransmittance) {
    TestScene test;
    add_sheet(test, test.add(glass(1.5f)), 1.0f);
    EXPECT_EQ(test.trace().transmittance({{0.2f, 3, 0.5f}, kDown}), 0.0f);
}

TEST(RayScene, BadTrianglesAreLeftOut) {
    TestScene test;
    const std::uint32_t white = test.add(lambert(Rgb(1.0f)));
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    test.triangle(white, {0, 1, 0}, {0, 1, 0}, {1, 1, 0});
    test.triangle(white, {0, 1, 0}, {1, 1, 0}, {2, 1, 0});
    test.triangle(white, {0, 1, 0}, {nan, 1, 0}, {1, 1, 1});
    test.triangle(white, {-1, 1, -1}, {inf, 1, 0}, {1, 1, 1});
    add_sheet(test, white, 0.0f);
    const auto hit = test.trace().closest({{0.2f, 3, 0.5f}, kDown}, 1);
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 3.0f);
    EXPECT_EQ(test.trace().bounds().max, Vec3(1, 0, 1));
    for (std::uint32_t t = 0; t < 6; ++t) EXPECT_EQ(test.trace().traced(t), t >= 4);
}

TEST(RayScene, NothingAtAllIsAScene) {
    TestScene test;
    test.add(lambert(Rgb(1.0f)));
    EXPECT_FALSE(test.trace().closest({Vec3(0), kDown}, 1));
    EXPECT_EQ(test.trace().transmittance({Vec3(0), kDown}), 1.0f);
    EXPECT_TRUE(test.trace().bounds().empty());
}

TEST(RayScene, OfTwinsTheFirstIsHit) {
    TestScene test;
    const std::uint32_t red = test.add(lambert({1, 0, 0})), blue = test.add(lambert({0, 0, 1}));
    for (int i = 0; i < 20; ++i) {
        const float x = float(i);
        test.triangle(red, {x, 0, 0}, {x, 0, 1}, {x + 1, 0, 0});
        test.triangle(blue, {x + 1, 0, 0}, {x, 0, 1}, {x, 0, 0});
    }
    for (int i = 0; i < 20; ++i) {
        const auto hit = test.trace().closest({{float(i) + 0.3f, 1, 0.3f}, kDown}, 1);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->triangle, std::uint32_t(2 * i));
    }
}

TEST(RayScene, OffsetsLeaveTheSurfaceAtAnyScale) {
    for (const float scale : {1e-3f, 1.0f, 1e3f, 1e6f}) {
        TestScene test;
        const Vec3 centre(3.0f * scale, -2.0f * scale, 5.0f * scale);
        const Vec3 u = glm::normalize(Vec3(1, 0.3f, 0.2f)), v = glm::normalize(Vec3(-0.1f, 0.2f, 1));
        test.quad(test.add(lambert(Rgb(1.0f))), centre - scale * (u + v), 2.0f * scale * u, 2.0f * scale * v);
        const RayScene& rays = test.trace();
        const Vec3 normal = glm::normalize(glm::cross(u, v));
        Random random(3, 0, 0);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 p = centre + scale * (1.8f * (random.next() - 0.5f) * u + 1.8f * (random.next() - 0.5f) * v);
            const Ray in{p + scale * normal, -normal};
            const auto hit = rays.closest(in, 0);
            ASSERT_TRUE(hit);
            const SurfacePoint point = rays.surface_point(in, *hit);
            const Vec3 out = glm::normalize(normal + 2.0f * (random.next() - 0.5f) * u + 2.0f * random.next() * v);
            for (const float side : {1.0f, -1.0f}) {
                const Vec3 origin = RayScene::offset_origin(point.position, point.geometric_normal, side * out);
                EXPECT_FALSE(rays.closest({origin, side * out}, 0)) << "scale " << scale;
            }
        }
    }
}

}  // namespace
}  // namespace daylit
