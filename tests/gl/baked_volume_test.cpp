// The shader's look-up in an irradiance volume against that of the CPU.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "small_scenes.h"
#include "tests/support/volume_builder.h"

namespace daylit {
namespace {

using namespace render_tests;

class BakedVolumeTest : public testing::Test {
  protected:
    void TearDown() override { EXPECT_NO_THROW(check_gl()); }
    std::unique_ptr<GlContext> context_ = make_any_context({.debug = true});
};

/// Corners with light of their own, mostly even, that changes between them.
IrradianceVolume uneven_volume() {
    Random random(7, 0, 0);
    IrradianceVolume volume = volume_of(Vec3(-1.5f, -0.5f, -2.0f), {4, 2, 5}, [&](int, int i, int) {
        return i == 0 ? 100.0f + 200.0f * random.next() : 60.0f * (random.next() - 0.5f);
    });
    for (std::int8_t& change : volume.changes) change = std::int8_t(int(255.0f * random.next()) - 127);
    volume.change_scale.assign(glsl::kVolumeNumbers, 20.0f);
    return volume;
}

/// What a small moving plate at a place shows, seen from straight before or behind it.
Rgb plate(const Baked& baked, const Vec3& center, const Vec3& normal, bool from_behind, Layer layer, double hour,
          bool dynamic = true) {
    const Vec3 u = glm::normalize(glm::cross(normal, Vec3(0.3f, 0.5f, -0.7f))), v = glm::cross(normal, u);
    constexpr float kHalf = 0.01f;
    Scene scene = scene_of({quad(center - kHalf * (u + v), center + kHalf * (u - v), center + kHalf * (u + v),
                                 center + kHalf * (v - u), 0)},
                           {lambert(Rgb(0.5f))});
    scene.materials[0].double_sided = true;
    scene.nodes[0].dynamic = dynamic;
    Renderer renderer(scene, &baked);
    renderer.set_lighting({{}, {Image(1, 1)}});
    View view = look_at(center + (from_behind ? -1.0f : 1.0f) * normal, center, 0.01f);
    FrameSettings frame = frame_of(view, 3, 3, layer);
    frame.hour = hour;
    renderer.draw(frame);
    return renderer.read_radiance().at(1, 1);
}

TEST_F(BakedVolumeTest, shader_and_cpu_agree_within_a_percent_gl) {
    Baked baked;
    baked.volume = uneven_volume();
    Random random(11, 0, 0);
    for (int i = 0; i < 12; ++i) {
        // Also beyond the border on every side.
        const Vec3 place(-2.5f + 5.0f * random.next(), -1.0f + 3.0f * random.next(), -3.0f + 6.0f * random.next());
        const Vec3 normal = glm::normalize(Vec3(random.next(), random.next(), random.next()) - 0.5f);
        const double hour = 6.0 + i;
        const bool behind = i % 2 == 1;
        const Rgb expected = light_of(*baked.volume).irradiance(place, behind ? -normal : normal);
        ASSERT_GT(expected.g, 50.0f);
        const Rgb found = plate(baked, place, normal, behind, Layer::Volume, hour);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.01f * expected[c]) << i << " " << c;
    }
}

TEST_F(BakedVolumeTest, moving_things_reflect_it_and_standing_ones_do_not_gl) {
    Baked baked;
    baked.volume = uneven_volume();
    const Vec3 place(0.1f, 0.2f, 0.3f), up(0, 1, 0);
    const float expected = 0.5f * light_of(*baked.volume).irradiance(place, up).g / float(kPi);
    EXPECT_NEAR(plate(baked, place, up, false, Layer::Final, 9.0).g, expected, 0.01f * expected);
    EXPECT_NEAR(plate(baked, place, up, false, Layer::Indirect, 9.0).g, expected, 0.01f * expected);
    EXPECT_EQ(plate(baked, place, up, false, Layer::Direct, 9.0), Rgb(0.0f));
    EXPECT_EQ(plate(baked, place, up, false, Layer::Indirect, 9.0, false), Rgb(0.0f));
}

}  // namespace
}  // namespace daylit
