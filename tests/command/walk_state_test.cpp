// The walk's camera, clock and sky worker.
#include <gtest/gtest.h>

#include <cmath>

#include "demo/parse.h"
#include "demo/walk/gaze.h"
#include "demo/walk/sky_worker.h"
#include "demo/walk/state.h"

namespace daylit {
namespace {

TEST(Gaze, a_view_and_back) {
    for (const Vec3& at : {Vec3(1, 2, -4), Vec3(5, 1, 3), Vec3(-3, -2, 0.5f)}) {
        const View view = look_at(Vec3(1, 2, 3), at, 0.8f);
        const View back = view_from_gaze(gaze_from_view(view));
        for (int column = 0; column < 4; ++column) {
            const Vec4 difference = view.view_from_world[column] - back.view_from_world[column];
            EXPECT_LT(glm::length(difference), 1e-5f);
        }
        EXPECT_EQ(back.vertical_fov, 0.8f);
    }
}

TEST(Gaze, yaw_and_pitch_are_what_they_say) {
    const Gaze left = gaze_from_view(look_at(Vec3(0), Vec3(-1, 0, 0), 1));
    EXPECT_NEAR(left.yaw, kPi / 2, 1e-6);
    EXPECT_NEAR(left.pitch, 0, 1e-6);
    const Gaze up = gaze_from_view(look_at(Vec3(0), Vec3(0, 1, -1), 1));
    EXPECT_NEAR(up.yaw, 0, 1e-6);
    EXPECT_NEAR(up.pitch, kPi / 4, 1e-6);
}

TEST(Gaze, straight_down_keeps_the_side_that_is_up) {
    // A map view: looks down, its top towards +X.
    View view;
    view.view_from_world = Mat4(glm::transpose(Mat3(Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0))));
    const Gaze gaze = gaze_from_view(view);
    EXPECT_NEAR(gaze.pitch, -kSteepestPitch, 1e-6);
    EXPECT_NEAR(gaze.yaw, -kPi / 2, 1e-5) << "ahead is +X";
}

TEST(Gaze, options_for_shot_name_the_same_picture) {
    Gaze gaze;
    gaze.eye = Vec3(1, 1.62f, -2);
    gaze.vertical_fov = float(60 * kDegree);
    EXPECT_EQ(shot_options(gaze), "--eye 1.000,1.620,-2.000 --at 1.000,1.620,-3.000 --fov 60.0");
}

TEST(Clock, wraps_and_reads) {
    EXPECT_DOUBLE_EQ(wrapped_hour(25.5), 1.5);
    EXPECT_DOUBLE_EQ(wrapped_hour(-1), 23);
    EXPECT_LT(wrapped_hour(-1e-18), 24);
    EXPECT_EQ(clock_text(7.5), "07:30");
    EXPECT_EQ(clock_text(23.9999), "00:00");
    EXPECT_EQ(clock_text(-0.25), "23:45");
}

LightSettings plain() {
    LightSettings settings;
    settings.sky = SkySource::Constant;
    settings.sky_radiance = Rgb(500);
    return settings;
}

TEST(SkyWorker, answers_what_the_model_answers) {
    SkyWorker worker({});
    worker.request(plain(), 12);
    const SkyWorker::Result result = worker.wait();
    ASSERT_TRUE(result.model);
    const Lighting expected = LightModel(plain(), {}).at(12);
    ASSERT_EQ(result.lighting.suns.size(), expected.suns.size());
    EXPECT_EQ(result.lighting.suns.at(0).irradiance, expected.suns.at(0).irradiance);
    EXPECT_EQ(result.lighting.sky.radiance(Vec3(0, 1, 0)), Rgb(500));
    EXPECT_FALSE(worker.take()) << "a result is taken once";
    EXPECT_FALSE(worker.busy());
}

TEST(SkyWorker, the_last_of_many_requests_wins) {
    SkyWorker worker({});
    LightSettings settings = plain();
    for (int i = 1; i <= 100; ++i) {
        settings.sky_radiance = Rgb(float(i));
        worker.request(settings, 12);
    }
    EXPECT_EQ(worker.wait().lighting.sky.radiance(Vec3(0, 1, 0)), Rgb(100));
}

TEST(SkyWorker, an_unusable_sky_is_told_and_the_next_one_works) {
    SkyWorker worker({});
    LightSettings settings;
    settings.sky = SkySource::File;
    settings.sky_file = "no such sky.exr";
    worker.request(settings, 12);
    const SkyWorker::Result failed = worker.wait();
    EXPECT_FALSE(failed.model);
    EXPECT_NE(failed.error.find("no such sky.exr"), std::string::npos);
    worker.request(plain(), 12);
    EXPECT_TRUE(worker.wait().model);
}

}  // namespace
}  // namespace daylit
