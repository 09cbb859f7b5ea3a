// Light and surfaces at the ends of their ranges: nothing is lost, nothing grows out of nothing.
#include <filesystem>

#include "engine/base/error.h"
#include "tests/stress/level.h"

namespace daylit::stress {
namespace {

constexpr double kSky = 1000.0;

Scene box(const Rgb& albedo, bool closed, const Rgb& emission = Rgb(0.0f), float metallic = 0.0f,
          float roughness = 1.0f) {
    Level level;
    level.room(Vec3(0.0f), Vec3(4, 3, 5), level.material(albedo, emission, metallic, roughness), closed);
    return level.load();
}

TEST(Albedo, BlackWallsShowTheSkyAlone) {
    const Scene scene = box(Rgb(0.0f), false);
    const LightSettings sky = constant_sky(float(kSky));
    const Light baked = baked_light(scene, coarse(sky)), traced = traced_light(scene, sky);
    EXPECT_LT(baked.most, kPi * kSky * 1.02);
    EXPECT_NEAR(baked.mean, traced.mean, 0.04 * traced.mean);
    EXPECT_EQ(baked_light(box(Rgb(0.0f), true), coarse(sky)).most, 0.0);
}

TEST(Albedo, WhiteWallsUnderTheSkyBecomeAsBrightAsTheSky) {
    // With albedo 1 all light that enters leaves again: inside and outside are in balance, E = pi L everywhere.
    const Scene scene = box(Rgb(1.0f), false);
    const LightSettings sky = constant_sky(float(kSky));
    EXPECT_NEAR(traced_light(scene, sky).mean, kPi * kSky, 0.02 * kPi * kSky);
    const Light baked = baked_light(scene, coarse(sky));
    EXPECT_NEAR(baked.mean, kPi * kSky, 0.04 * kPi * kSky);
    EXPECT_LT(baked.most, kPi * kSky * 1.1);
}

TEST(Albedo, AClosedWhiteRoomEndsThoughItsLightNeverDoes) {
    const Scene scene = box(Rgb(1.0f), true, Rgb(1.0f));
    constexpr int kBounces = 20;
    BakeSettings settings = coarse(no_light());
    settings.bounces = kBounces;
    const Light baked = baked_light(scene, settings), traced = traced_light(scene, no_light(), 16, kBounces);
    // Each bounce adds as much as the emission gave.
    EXPECT_LT(baked.most, kPi * (kBounces + 2) * 1.02);
    EXPECT_LT(traced.mean, kPi * (kBounces + 2) * 1.02);
    EXPECT_GT(baked.mean, kPi);
    settings.bounces = BakeSettings{}.bounces;
    baked_light(scene, settings);
    traced_light(scene, no_light(), 2, PathTraceSettings{}.max_bounces, 12.0, 20);
}

TEST(Emission, FromNearlyNothingToWelding) {
    for (const float emission : {1e-6f, 1.0f, 1e9f}) {
        const Scene scene = box(Rgb(0.5f), true, Rgb(emission));
        const double expected = kPi * double(emission) / (1.0 - 0.5);
        EXPECT_NEAR(traced_light(scene, no_light()).mean, expected, 0.02 * expected) << emission;
        EXPECT_NEAR(baked_light(scene, coarse(no_light())).mean, expected, 0.02 * expected) << emission;
    }
}

TEST(Lamps, FromAMillionthOfACandelaToAThousandMillion) {
    const auto lit = [](float candela) {
        Level level;
        level.room(Vec3(0.0f), Vec3(4, 3, 5), level.material(Rgb(0.5f)), true);
        level.lamp({2, 1.5f, 2.5f}, candela);
        return level.load();
    };
    const Light traced = traced_light(lit(1.0f), no_light()), baked = baked_light(lit(1.0f), coarse(no_light()));
    EXPECT_NEAR(baked.mean, traced.mean, 0.05 * traced.mean);
    for (const float candela : {1e-6f, 1e9f}) {
        const Scene scene = lit(candela);
        EXPECT_NEAR(traced_light(scene, no_light()).mean / double(candela), traced.mean, 0.01 * traced.mean) << candela;
        EXPECT_NEAR(baked_light(scene, coarse(no_light())).mean / double(candela), baked.mean, 0.02 * baked.mean)
            << candela;
    }
}

TEST(Lamps, OneThatTouchesTheWall) {
    Level level;
    level.room(Vec3(0.0f), Vec3(4, 3, 5), level.material(Rgb(0.5f)), true);
    level.lamp({2, 0, 2.5f}, 100.0f);
    level.lamp({2, 1e-6f, 1.5f}, 100.0f);
    const Scene scene = level.load();
    baked_light(scene, coarse(no_light()));
    traced_light(scene, no_light());
}

TEST(Gloss, NoLobeMakesLight) {
    for (const float roughness : {0.0f, 0.001f, 0.03f, 0.5f}) {  // exponents from 1e6, where they are cut, down to 30
        const Scene scene = box(Rgb(1.0f), false, Rgb(0.0f), 1.0f, roughness);
        const LightSettings sky = constant_sky(float(kSky));
        EXPECT_LT(traced_light(scene, sky, 16).mean, kPi * kSky * 1.02) << roughness;
        EXPECT_LT(baked_light(scene, coarse(sky)).most, kPi * kSky * 1.1) << roughness;
    }
}

TEST(Gloss, AHallOfMirrorsEnds) {
    Level level;
    const int mirror = level.material(Rgb(1.0f), Rgb(0.0f), 1.0f, 0.0f);
    const int lamp = level.material(Rgb(0.0f), Rgb(100.0f));
    level.room(Vec3(0.0f), Vec3(4, 3, 5), mirror, true);
    level.quad({1.5f, 2.9f, 2}, {1, 0, 0}, {0, 0, 1}, lamp);  // takes what comes back to it
    const Scene scene = level.load();
    // Never brighter than the lamp itself all around.
    EXPECT_LT(traced_light(scene, no_light(), 8, 1000, 12.0, 30).mean, kPi * 100.0 * 1.05);
    EXPECT_LT(baked_light(scene, coarse(no_light())).most, kPi * 100.0 * 1.1);
}

TEST(Day, AllBlackAndAllEqual) {
    const Scene scene = box(Rgb(0.5f), false);
    const Baked black = bake(scene, coarse(no_light()));
    ASSERT_TRUE(black.lightmap);
    const std::vector<SurfaceSample> points = places(scene, 100);
    for (const double hour : {0.0, 6.0, 12.0, 23.99})
        EXPECT_EQ(sound(lightmap_light(black, scene, hour, points), "black").most, 0.0);

    const Baked equal = bake(scene, coarse(constant_sky(float(kSky))));
    ASSERT_TRUE(equal.lightmap);
    const std::vector<Rgb> noon = lightmap_light(equal, scene, 12.0, points);
    for (const double hour : {0.0, 3.3, 23.99}) EXPECT_EQ(lightmap_light(equal, scene, hour, points), noon);
}

TEST(Day, PolarNightHasNoSunAndNoNegativeLight) {
    const Scene scene = box(Rgb(0.5f), false);
    BakeSettings settings = coarse(LightSettings{});
    settings.light.day.latitude = 85.0, settings.light.day.date = {2026, 12, 21};
    settings.every_hours = 1.0;
    const Baked baked = bake(scene, settings);
    ASSERT_TRUE(baked.lightmap);
    const std::vector<SurfaceSample> points = places(scene, 100);
    for (double hour = 0.0; hour < 24.0; hour += 1.7)
        EXPECT_LT(sound(lightmap_light(baked, scene, hour, points), "polar night").most, 1.0) << hour;
}

TEST(Day, TheWholeDayIsSound) {
    const Scene scene = box(Rgb(0.7f), false);
    BakeSettings settings = coarse(LightSettings{});
    settings.every_hours = 1.0;
    const Baked baked = bake(scene, settings);
    ASSERT_TRUE(baked.lightmap);
    const std::vector<SurfaceSample> points = places(scene, 200);
    for (double hour = 0.0; hour < 24.0; hour += 0.37)  // between keyframes too
        EXPECT_LT(sound(lightmap_light(baked, scene, hour, points), "day").most, 2e5) << hour;
}

TEST(Reader, UnitsAtTheEndsOfTheirRange) {
    for (const double unit : {1e-6, 1e-3, 1e3, 1e6}) {
        Level level;
        level.room(Vec3(0.0f), Vec3(4, 3, 5), level.material(Rgb(0.5f)), false);
        level.lamp({2, 1, 2}, 10.0f);
        try {
            const Scene scene = level.load({.unit = unit});
            EXPECT_LT(baked_light(scene, coarse(constant_sky(1.0f))).mean, 1e15) << unit;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace daylit::stress
