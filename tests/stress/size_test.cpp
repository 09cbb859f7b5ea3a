// Levels of any size, anywhere, of any shape of triangle: light does not know metres, only angles.
#include "engine/base/error.h"
#include "tests/stress/level.h"

namespace daylit::stress {
namespace {

/// An open box under a sky of radiance 1: at most pi lux arrive anywhere.
Scene open_box(double size, const Vec3& place, float albedo = 0.5f) {
    Level level;
    level.room(place, float(size) * Vec3(4, 3, 5), level.material(Rgb(albedo)), false);
    return level.load();
}

TEST(Scale, LightIsTheSameFromAMillimetreToAHundredKilometres) {
    const LightSettings sky = constant_sky(1.0f);
    const Light one = baked_light(open_box(1.0, Vec3(0.0f)), coarse(sky));
    const Light traced_one = traced_light(open_box(1.0, Vec3(0.0f)), sky);
    EXPECT_NEAR(one.mean, traced_one.mean, 0.04 * traced_one.mean);
    for (const double size : {1e-3, 1e3, 1e5}) {
        const Scene scene = open_box(size, Vec3(0.0f));
        const Light baked = baked_light(scene, coarse(sky)), traced = traced_light(scene, sky);
        EXPECT_NEAR(baked.mean, one.mean, 0.02 * one.mean) << size;
        EXPECT_NEAR(traced.mean, traced_one.mean, 0.04 * one.mean) << size;
        EXPECT_LT(baked.most, kPi * 1.02) << size;
    }
}

TEST(Offset, LightIsTheSameFarFromTheOrigin) {
    const LightSettings sky = constant_sky(1.0f);
    const Light here = baked_light(open_box(1.0, Vec3(0.0f)), coarse(sky));
    for (const float offset : {1e3f, 1e4f}) {
        const Scene scene = open_box(1.0, Vec3(offset, -offset, offset));
        EXPECT_NEAR(baked_light(scene, coarse(sky)).mean, here.mean, 0.03 * here.mean) << offset;
        EXPECT_NEAR(traced_light(scene, sky).mean, here.mean, 0.05 * here.mean) << offset;
    }
}

TEST(Offset, AMillionMetresAwayTheLightIsStillBounded) {
    // Floats are 6 cm apart there: a box of 400 m keeps its shape, one of 4 m barely.
    const LightSettings sky = constant_sky(1.0f);
    const Light here = baked_light(open_box(1.0, Vec3(0.0f)), coarse(sky));
    const Scene large = open_box(100.0, Vec3(1e6f)), small = open_box(1.0, Vec3(1e6f));
    EXPECT_NEAR(baked_light(large, coarse(sky)).mean, here.mean, 0.05 * here.mean);
    EXPECT_NEAR(traced_light(large, sky).mean, here.mean, 0.05 * here.mean);
    EXPECT_LT(baked_light(small, coarse(sky)).most, kPi * 1.02);
    EXPECT_LT(traced_light(small, sky).most, kPi * 1.02);
}

TEST(Slivers, TrianglesWithoutAreaChangeNothing) {
    const LightSettings sky = constant_sky(1.0f);
    const Light clean = baked_light(open_box(1.0, Vec3(0.0f)), coarse(sky));
    Level level;
    const int grey = level.material(Rgb(0.5f));
    level.room(Vec3(0.0f), Vec3(4, 3, 5), grey, false);
    std::vector<Vec3> corners;
    for (int i = 0; i < 300; ++i) {
        const Vec3 p(0.01f * float(i) + 0.2f, 1.0f, 2.0f);
        switch (i % 5) {
            case 0:
                corners.insert(corners.end(), {p, p, p});
                break;
            case 1:
                corners.insert(corners.end(), {p, p + Vec3(1, 0, 0), p});
                break;
            case 2:
                corners.insert(corners.end(), {p, p + Vec3(1, 0, 0), p + Vec3(2, 0, 0)});
                break;
            case 3:
                corners.insert(corners.end(), {p, p + Vec3(1e-20f, 0, 0), p + Vec3(0, 1e-20f, 0)});
                break;
            default:
                corners.insert(corners.end(), {p, p + Vec3(0, 1, 0), p + Vec3(0, 1, 1e-7f)});
        }
    }
    level.triangles(corners, grey);
    const Scene scene = level.load();
    EXPECT_NEAR(baked_light(scene, coarse(sky)).mean, clean.mean, 0.05 * clean.mean);
    EXPECT_NEAR(traced_light(scene, sky).mean, clean.mean, 0.05 * clean.mean);
}

TEST(Slivers, NeedlesOfAKilometreBesideAGrainOfSand) {
    Level level;
    const int grey = level.material(Rgb(0.5f));
    for (int i = 0; i < 40; ++i) {
        const float y = 0.1f * float(i);
        level.triangles({{0, y, 0}, {1000, y, 0}, {1000, y, 1e-4f}}, grey);
        level.triangles({{0, y, 5}, {1e-4f, y, 5}, {0, y, 5.0001f}}, grey);
    }
    const Scene scene = level.load();
    EXPECT_LT(baked_light(scene, coarse(constant_sky(1.0f))).most, kPi * 1.02);
    EXPECT_LT(traced_light(scene, constant_sky(1.0f)).most, kPi * 1.02);
}

TEST(Size, OneTexelOneHour) {
    Level level;
    level.triangles({{0, 0, 0}, {0, 0, 1e-3f}, {1e-3f, 0, 0}}, level.material(Rgb(0.5f)));
    const Scene scene = level.load();
    BakeSettings settings = coarse(constant_sky(1.0f));
    settings.tuning.texels = 1e-9;
    settings.tuning.rays = 1e-9;
    EXPECT_LT(baked_light(scene, settings).most, kPi * 1.02);
    settings.tuning.rays = 1.0;
    EXPECT_NEAR(baked_light(scene, settings).mean, kPi, 0.02 * kPi);  // open all around

    BakeSettings hour = coarse(LightSettings{});
    hour.from_hour = hour.to_hour = 12.0;
    EXPECT_GT(baked_light(scene, hour).mean, 0.0);
}

TEST(Size, ATexelBudgetBeyondAllLimitsIsRefused) {
    BakeSettings settings = coarse(constant_sky(1.0f));
    settings.tuning.texels = 1e8;
    EXPECT_THROW(bake(open_box(1.0, Vec3(0.0f)), settings), Error);
}

// Two rooms with a wall of 5 cm between them: the dim one must not see the lamp of the other, 100 times as strong.
TEST(ThinWall, TheDarkSideIsTheTruth) {
    Level level;
    const int grey = level.material(Rgb(0.7f));
    level.room({-3, 0, -2}, {2.975f, 2.6f, 4}, grey, true);
    level.room({0.025f, 0, -2}, {2.975f, 2.6f, 4}, grey, true);
    level.lamp({-1.2f, 1.6f, 0}, 200.0f);
    level.lamp({1.2f, 1.6f, 0}, 2.0f);
    const Scene scene = level.load();
    BakeSettings settings = coarse(no_light());
    settings.error = 0.03;
    const Baked baked = bake(scene, settings);

    std::vector<SurfaceSample> dark;
    for (float y = 0.1f; y < 2.55f; y += 0.2f)
        for (float z = -1.9f; z < 1.95f; z += 0.2f) dark.push_back({{0.025f, y, z}, {1, 0, 0}});
    const Light found = sound(lightmap_light(baked, scene, 12.0, dark), "baked");
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::All);
    const RayScene rays(scene, mesh);
    const std::vector<PlacedLight> lamps = placed_lights(scene, pose_scene(scene));
    const Light truth = sound(path_trace_irradiance(rays, LightModel(baked.light, lamps).at(12.0), lamps, dark,
                                                    {.spp = 1024, .layer = Layer::Indirect}),
                              "traced");
    EXPECT_GT(truth.mean, 0.05);
    EXPECT_NEAR(found.mean, truth.mean, 0.02 * truth.mean);
}

}  // namespace
}  // namespace daylit::stress
