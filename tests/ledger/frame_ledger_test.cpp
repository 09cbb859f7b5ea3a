// What a frame did not need to do, it did not do: read from the renderer's own counters.
#include <gtest/gtest.h>

#include "engine/gl/context.h"
#include "engine/render/renderer.h"
#include "tests/stress/level.h"

namespace daylit {
namespace {

using stress::Level;

/// A room with an opening, with or without a lamp, and its coarse bake of a day.
struct Lit {
    explicit Lit(bool with_lamp) {
        Level level;
        level.room({-2, 0, -2}, {4, 3, 4}, level.material(Rgb(0.5f)), false);
        if (with_lamp) level.lamp({0, 2, 0}, 100.0f);
        scene = level.load();
        BakeSettings settings = stress::coarse(LightSettings{});
        settings.every_hours = 3.0;
        baked = bake(scene, settings);
    }
    Scene scene;
    Baked baked;
    LightModel light{LightSettings{}, {}};
};

class FrameLedger : public testing::Test {
  protected:
    FrameReport draw(Renderer& renderer, const Lit& lit, double hour, Layer layer = Layer::Final, float eye = 1.0f) {
        renderer.set_lighting(lit.light.at(hour));
        FrameSettings frame;
        frame.view = look_at({eye, 2.5f, eye}, {0, 0, 0}, 1.0f);
        frame.width = 64, frame.height = 48;
        frame.hour = hour, frame.show = layer, frame.ev = 10.0;
        const FrameReport report = renderer.draw(frame);
        for (const PassReport& pass : report.passes) {
            EXPECT_FALSE(pass.why.empty()) << pass.name;
            if (pass.ran) continue;
            EXPECT_EQ(pass.draws, 0) << pass.name;
            EXPECT_EQ(pass.triangles, 0) << pass.name;
        }
        return report;
    }
    static bool ran(const FrameReport& report, const std::string& name) {
        for (const PassReport& pass : report.passes)
            if (pass.name == name) return pass.ran;
        ADD_FAILURE() << "no pass " << name;
        return false;
    }
    std::unique_ptr<GlContext> context_ = make_any_context();
};

TEST_F(FrameLedger, a_still_sun_moves_nothing_gl) {
    const Lit lit(true);
    Renderer renderer(lit.scene, &lit.baked);
    const FrameReport first = draw(renderer, lit, 12.0);
    for (const char* pass : {"relight", "sun shadows", "lamp shadows", "surfaces"})
        EXPECT_TRUE(ran(first, pass)) << pass;
    const FrameReport still = draw(renderer, lit, 12.0);
    for (const char* pass : {"relight", "sun shadows", "lamp shadows"}) EXPECT_FALSE(ran(still, pass)) << pass;
    EXPECT_TRUE(ran(still, "surfaces"));
}

TEST_F(FrameLedger, a_moving_sun_leaves_the_lamps_alone_gl) {
    const Lit lit(true);
    Renderer renderer(lit.scene, &lit.baked);
    draw(renderer, lit, 12.0);
    const FrameReport moved = draw(renderer, lit, 13.0);
    EXPECT_TRUE(ran(moved, "relight"));
    EXPECT_TRUE(ran(moved, "sun shadows"));
    EXPECT_FALSE(ran(moved, "lamp shadows"));
}

TEST_F(FrameLedger, a_moving_camera_relights_nothing_gl) {
    const Lit lit(true);
    Renderer renderer(lit.scene, &lit.baked);
    draw(renderer, lit, 12.0);  // sees the whole room
    const FrameReport walked = draw(renderer, lit, 12.0, Layer::Final, 1.3f);
    EXPECT_FALSE(ran(walked, "relight"));
    EXPECT_FALSE(ran(walked, "lamp shadows"));
}

TEST_F(FrameLedger, night_has_no_sun_shadows_gl) {
    const Lit lit(true);
    Renderer renderer(lit.scene, &lit.baked);
    EXPECT_FALSE(ran(draw(renderer, lit, 1.0), "sun shadows"));
    EXPECT_TRUE(ran(draw(renderer, lit, 12.0), "sun shadows"));
}

TEST_F(FrameLedger, no_lamp_no_lamp_pass_and_no_bake_no_relight_gl) {
    const Lit lit(false);
    Renderer baked(lit.scene, &lit.baked), unbaked(lit.scene, nullptr);
    for (const double hour : {12.0, 13.0}) {
        EXPECT_FALSE(ran(draw(baked, lit, hour), "lamp shadows"));
        EXPECT_FALSE(ran(draw(unbaked, lit, hour), "relight"));
    }
}

TEST_F(FrameLedger, layers_run_what_they_show_gl) {
    const Lit lit(true);
    Renderer renderer(lit.scene, &lit.baked);
    const FrameReport albedo = draw(renderer, lit, 12.0, Layer::Albedo);
    for (const char* pass : {"relight", "sun shadows", "lamp shadows", "sky"}) EXPECT_FALSE(ran(albedo, pass)) << pass;
    EXPECT_FALSE(ran(draw(renderer, lit, 12.0, Layer::Direct), "relight"));
    const FrameReport indirect = draw(renderer, lit, 12.0, Layer::Indirect);
    EXPECT_TRUE(ran(indirect, "relight"));
    for (const char* pass : {"sun shadows", "lamp shadows", "sky"}) EXPECT_FALSE(ran(indirect, pass)) << pass;
}

TEST_F(FrameLedger, nothing_in_view_draws_nothing_gl) {
    const Lit lit(false);
    Renderer renderer(lit.scene, &lit.baked);
    renderer.set_lighting(lit.light.at(12.0));
    FrameSettings frame;
    frame.view = look_at({0, 50, 0}, {0, 100, 1}, 1.0f);  // above the room, looking up
    frame.width = 64, frame.height = 48, frame.ev = 10.0;
    const FrameReport report = renderer.draw(frame);
    EXPECT_EQ(report.objects_drawn, 0);
    EXPECT_GT(report.objects_culled, 0);
}

}  // namespace
}  // namespace daylit
