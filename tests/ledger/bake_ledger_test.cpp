// What a bake did not need to do, it did not do: read from its plan, its columns and its counters.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "gi/bake_plan.h"
#include "gi/transport/day_gather/sun_rows.h"
#include "tests/stress/level.h"

namespace daylit {
namespace {

using stress::Level;

TEST(BakeLedger, HoursOfDeepNightAreNotSolvedFor) {
    LightSettings settings;
    settings.day.date = {2026, 12, 21};
    const LightModel light(settings, {});
    const std::vector<double> hours = baked_hours(light, 0.0, 24.0, 1.0 / 12.0);
    EXPECT_LT(hours.size(), 200u);  // of 289
    for (const double hour : hours)
        EXPECT_GT(sun_position(settings.day, hour).elevation, -21.0 * kDegree) << hour;  // and the hour next to it
    for (double hour = 0.0; hour < 24.0; hour += 1.0 / 12.0) {
        if (light.suns(hour).empty()) continue;
        EXPECT_TRUE(std::any_of(hours.begin(), hours.end(), [&](double h) { return std::abs(h - hour) < 1e-6; }))
            << hour;
    }
}

TEST(BakeLedger, LightThatIsNotThereHasNoColumns) {
    const auto columns = [](const LightSettings& settings) {
        const LightModel model(settings, {});
        return day_light(model, baked_hours(model, 0.0, 24.0, 1.0)).columns;
    };
    const DayColumns day = columns(LightSettings{});
    EXPECT_EQ(day.suns, day.hours.size());
    EXPECT_EQ(day.skies, day.hours.size());

    LightSettings no_sun;
    no_sun.sun = SunSource::None;
    EXPECT_EQ(columns(no_sun).suns, 0u);
    LightSettings no_sky;
    no_sky.sky = SkySource::None;
    EXPECT_EQ(columns(no_sky).skies, 0u);
    LightSettings still = stress::constant_sky(1.0f);
    EXPECT_EQ(columns(still).hours.size(), 1u);
    EXPECT_EQ(columns(still).skies, 1u);
    still.sun = SunSource::Given;
    EXPECT_EQ(columns(still).suns, 1u);
}

/// A floor, open to the sky or under a roof so wide that the sun never comes in.
struct Floor {
    explicit Floor(bool roofed) {
        Level level;
        const int grey = level.material(Rgb(0.5f));
        level.quad({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, grey);
        if (roofed) level.quad({-1e5f, 1, -1e5f}, {2e5f, 0, 0}, {0, 0, 2e5f}, grey);
        scene = level.load();
        mesh = world_mesh(scene, pose_scene(scene), Part::Static);
    }
    Scene scene;
    WorldMesh mesh;
};

TEST(BakeLedger, WhereTheSunNeverComesOnlyTheFirstTestsAreMade) {
    const LightModel light(LightSettings{}, {});
    const std::vector<double> hours = baked_hours(light, 0.0, 24.0, 1.0 / 12.0);
    const DayLight day = day_light(light, hours);
    const std::size_t lit =
        std::size_t(std::count_if(day.suns.begin(), day.suns.end(), [](const auto& s) { return !s.empty(); }));
    ASSERT_GT(lit, 150u);
    for (const bool roofed : {false, true}) {
        const Floor floor(roofed);
        const RayScene rays(floor.scene, floor.mesh);
        const Atlas atlas = make_atlas(floor.mesh, 400);
        const Texels texels = make_texels(floor.mesh, atlas);
        const GatherScene scene = gather_scene(rays, atlas, texels, {});
        const Progress quiet;
        const StageProgress progress{quiet};
        const GatherSettings how{.rays = 8};
        Checkpoint nowhere;
        const GatherHits hits = trace_hits(scene, how, nowhere, progress);
        const SunRows rows(scene, hits, hours, day.suns, how, progress);
        std::size_t receivers = 0;  // of the floor's front
        for (std::size_t r = 0; r < texels.count(); ++r) {
            if (texels.position[r].y > 0.5f) continue;
            ++receivers;
            EXPECT_EQ(rows.row(r).values.empty(), roofed);
        }
        ASSERT_GT(receivers, 0u);
        // Less than one ray for each receiver and hour, though each has several samples.
        EXPECT_LT(rows.tests(), hits.receivers.size() * lit) << (roofed ? "roofed" : "open");
    }
}

TEST(BakeLedger, PartsWithoutUseAreNotBaked) {
    Level level;
    level.room(Vec3(0.0f), Vec3(4, 3, 5), level.material(Rgb(0.5f)), false);
    BakeSettings settings = stress::coarse(stress::constant_sky(1.0f));
    settings.parts.clear();
    const Baked baked = bake(level.load(), settings);
    EXPECT_TRUE(baked.lightmap);
    EXPECT_FALSE(baked.volume);
    for (const PlanItem& item : baked.plan) {
        EXPECT_EQ(item.done, item.part == "lightmap") << item.part;
        EXPECT_FALSE(item.why.empty()) << item.part;
    }
}

TEST(BakeLedger, SectionsThatNobodyWantsAreNotRead) {
    Level level;
    level.room(Vec3(0.0f), Vec3(4, 3, 5), level.material(Rgb(0.5f)), false);
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "light.daylit";
    write_baked(file, bake(level.load(), stress::coarse(stress::constant_sky(1.0f))));
    std::vector<std::uint8_t> bytes = read_file(file);
    bytes.back() ^= 1;  // of the lightmap, the only part and the last section
    write_file(file, bytes);
    EXPECT_THROW(read_baked(file), Error);
    EXPECT_FALSE(read_baked(file, {.lightmap = false, .volume = false}).lightmap);
}

}  // namespace
}  // namespace daylit
