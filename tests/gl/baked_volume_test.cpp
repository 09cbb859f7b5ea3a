// The shader's look-up in an irradiance volume against that of the CPU.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/render/volume_view.h"
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
    volume.change_step.assign(3 * volume.tree.samples, 20.0f / 127.0f);
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

constexpr int kPixels = 12;
const Vec3 kMiddle(0.3f, 0.45f, 0.2f), kUp(0, 1, 0);

/// Irradiance shown on a square that moves, facing up, all of it in the picture.
Image square(const Baked& baked, float side, VolumeMode mode, const Material& material = lambert(Rgb(0.5f))) {
    Scene scene = scene_of({ground(kMiddle, side, side, 0)}, {material});  // reaches over the picture's edges
    scene.nodes[0].dynamic = true;
    Renderer renderer(scene, &baked);
    renderer.set_lighting({{}, {Image(1, 1)}});
    FrameSettings frame = frame_of(from_above(side, kMiddle), kPixels, kPixels, Layer::Volume);
    frame.volume_mode = mode;
    renderer.draw(frame);
    return renderer.read_radiance();
}

/// RMS over mean against the look-up of the CPU at every pixel.
double error_of(const Image& image, const VolumeLight& light, float side) {
    double wrong = 0.0, mean = 0.0;
    for (int y = 0; y < kPixels; ++y)
        for (int x = 0; x < kPixels; ++x) {
            const Vec3 in((float(x) + 0.5f) / kPixels - 0.5f, 0.0f, (float(y) + 0.5f) / kPixels - 0.5f);
            const float expected = light.irradiance(kMiddle + side * in, kUp).g;
            wrong += std::pow(double(image.at(x, y).g - expected), 2.0), mean += double(expected);
        }
    return std::sqrt(wrong * kPixels * kPixels) / mean;
}

TEST_F(BakedVolumeTest, modes_look_up_where_they_say_gl) {
    Baked baked;
    baked.volume = uneven_volume();
    const VolumeLight light = light_of(*baked.volume);
    constexpr float kSide = 1.2f;
    const double pixel = error_of(square(baked, kSide, VolumeMode::Pixel), light, kSide),
                 vertex = error_of(square(baked, kSide, VolumeMode::Vertex), light, kSide),
                 object = error_of(square(baked, kSide, VolumeMode::Object), light, kSide);
    EXPECT_LT(pixel, 0.001);
    EXPECT_GT(vertex, 0.05);  // four vertices, and cells of a metre
    EXPECT_GT(object, 0.05);
    const Image once = square(baked, kSide, VolumeMode::Object);
    const float middle = light.irradiance(kMiddle, kUp).g;
    for (const Rgb& p : once.pixels) EXPECT_NEAR(p.g, middle, 0.001f * middle);
}

TEST_F(BakedVolumeTest, auto_mode_goes_by_size_gl) {
    Baked baked;
    baked.volume = uneven_volume();
    // Twice as long as the picture: a quarter of a cell, and a little more. Two triangles have no vertices in between.
    EXPECT_EQ(square(baked, 0.120f, VolumeMode::Auto).pixels, square(baked, 0.120f, VolumeMode::Object).pixels);
    EXPECT_EQ(square(baked, 0.130f, VolumeMode::Auto).pixels, square(baked, 0.130f, VolumeMode::Pixel).pixels);
}

TEST_F(BakedVolumeTest, auto_mode_takes_metal_at_its_pixels_whatever_its_size_gl) {
    Baked baked;
    baked.volume = uneven_volume();
    Material metal;
    metal.metallic = 1.0f, metal.roughness = 0.4f;
    const Image by_itself = square(baked, 0.05f, VolumeMode::Auto, metal);
    EXPECT_EQ(by_itself.pixels, square(baked, 0.05f, VolumeMode::Pixel, metal).pixels);
    EXPECT_NE(by_itself.pixels, square(baked, 0.05f, VolumeMode::Object, metal).pixels);
    EXPECT_EQ(square(baked, 0.05f, VolumeMode::Auto).pixels, square(baked, 0.05f, VolumeMode::Object).pixels);
}

/// Two squares of four triangles each that move, side by side; the picture shows the place around x alone.
struct TwoThings {
    TwoThings() {
        baked.volume = uneven_volume();
        baked.volume->basis.curves[baked.volume->basis.still(StillColumn::Evening)] = 1.0f;
        scene = scene_of({}, {lambert(Rgb(0.5f))});
        for (const float x : {-1.0f, 1.0f}) {
            Primitive square = ground(Vec3(x, 0.5f, 0.0f), 0.3f, 0.3f, 0);
            square.indices.insert(square.indices.end(), {0, 1, 3, 1, 2, 3});
            scene.meshes.push_back({"square", {square}, {}});
            Node node;
            node.mesh = int(scene.nodes.size());
            node.dynamic = true;
            scene.order.push_back(node.mesh);
            scene.nodes.push_back(node);
        }
    }
    /// The triangles that were lit for it.
    static long draw(Renderer& renderer, float x, VolumeMode mode, double hour = 12.0, Layer layer = Layer::Volume) {
        LightScales scales;
        scales.evening = hour == 12.0 ? 1.0f : 0.5f;
        renderer.set_lighting({{}, {Image(1, 1)}, scales});
        FrameSettings frame = frame_of(from_above(1.0f, Vec3(x, 0.5f, 0.0f)), kPixels, kPixels, layer);
        frame.hour = hour;
        frame.volume_mode = mode;
        const FrameReport report = renderer.draw(frame);
        EXPECT_EQ(pass(report, "moving light").ran, pass(report, "moving light").triangles > 0);
        return pass(report, "moving light").triangles;
    }
    Pose pose(float lift, float turn = 0.0f) const {
        Scene moved = scene;
        moved.nodes[0].rotation = glm::angleAxis(turn, Vec3(0, 0, 1));
        moved.nodes[0].translation = Vec3(0, lift, 0);
        return pose_scene(moved);
    }
    Scene scene;
    Baked baked;
};

TEST_F(BakedVolumeTest, only_what_is_seen_and_moved_is_looked_up_gl) {
    const TwoThings things;
    for (const VolumeMode mode : {VolumeMode::Object, VolumeMode::Vertex}) {
        Renderer renderer(things.scene, &things.baked);
        EXPECT_EQ(TwoThings::draw(renderer, -1.0f, mode), 4);
        EXPECT_EQ(TwoThings::draw(renderer, -1.0f, mode), 0);  // all is still
        EXPECT_EQ(TwoThings::draw(renderer, 1.0f, mode), 4);   // comes into view
        EXPECT_EQ(TwoThings::draw(renderer, -1.0f, mode), 0);
        renderer.set_pose(things.pose(0.2f));
        EXPECT_EQ(TwoThings::draw(renderer, 1.0f, mode), 0);  // the other one moved
        EXPECT_EQ(TwoThings::draw(renderer, -1.0f, mode, 12.0, Layer::Direct), 0);
        EXPECT_EQ(TwoThings::draw(renderer, -1.0f, mode), 4);
        EXPECT_EQ(TwoThings::draw(renderer, -1.0f, mode, 13.0), 4);  // another light
        EXPECT_EQ(TwoThings::draw(renderer, 1.0f, mode, 13.0), 4);
        EXPECT_EQ(TwoThings::draw(renderer, 1.0f, mode, 13.0), 0);
        EXPECT_EQ(TwoThings::draw(renderer, 1.0f, VolumeMode::Pixel, 13.0), 0);  // the shader's work
    }
}

TEST_F(BakedVolumeTest, what_is_kept_is_what_a_new_renderer_shows_gl) {
    const TwoThings things;
    for (const VolumeMode mode : {VolumeMode::Object, VolumeMode::Vertex}) {
        Renderer kept(things.scene, &things.baked);
        TwoThings::draw(kept, -1.0f, mode);
        const Image before = kept.read_radiance();
        kept.set_pose(things.pose(0.2f, 0.3f));
        TwoThings::draw(kept, -1.0f, mode, 13.0);
        EXPECT_NE(kept.read_radiance().pixels, before.pixels);
        Renderer fresh(things.scene, &things.baked);
        fresh.set_pose(things.pose(0.2f, 0.3f));
        TwoThings::draw(fresh, -1.0f, mode, 13.0);
        EXPECT_EQ(kept.read_radiance().pixels, fresh.read_radiance().pixels);
    }
}

/// The view of samples and cells around the volume's corner (0, 0, 0), seen from straight above over a standing floor.
FrameReport look_at_samples(const Baked& baked, Layer layer, bool asked, Image& image) {
    const Scene scene = scene_of({ground(Vec3(0, -1, 0), 5, 5, 0)}, {lambert(Rgb(0.5f))});
    Renderer renderer(scene, &baked);
    renderer.set_lighting({{}, {Image(1, 1)}});
    FrameSettings frame = frame_of(from_above(2.2f, Vec3(0)), 221, 221, layer);
    frame.volume_view = asked;
    const FrameReport report = renderer.draw(frame);
    image = renderer.read_radiance();
    return report;
}

TEST_F(BakedVolumeTest, samples_are_spheres_with_their_light_and_cells_are_lines_gl) {
    Baked baked;
    baked.volume = volume_of(Vec3(-1, 0, -1), {2, 1, 2}, [](int record, int i, int channel) {
        return i == 0 ? 100.0f + 10.0f * float(record) : i == 1 ? 20.0f : 5.0f * float(channel);
    });
    Image image;
    EXPECT_TRUE(pass(look_at_samples(baked, Layer::Volume, true, image), "volume view").ran);
    // Records are 3 x 2 x 3; those of the upper layer are seen, the middle one's number is 3 * 2 + 3 + 1. A pixel is a
    // centimetre.
    const Rgb top =
        VolumeLight(*baked.volume, baked.volume->basis.weights({}, 12.0)).irradiance(Vec3(0, 1, 0), Vec3(0, 1, 0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(110, 110)[c], top[c], 0.01f * top[c]) << c;
    EXPECT_GT(image.at(113, 112).g, 100.0f);   // a sphere of 4 cm
    EXPECT_EQ(image.at(118, 117), Rgb(0.0f));  // beside it the floor, which the volume does not light
    const Rgb line = image.at(160, 110);       // half way to the next sample
    const float mean = float(kPi) * 0.282095f * (200.0f + 0.5f * 10.0f);
    EXPECT_NEAR(line.g, mean, 0.02f * mean);
    Image radiance;
    look_at_samples(baked, Layer::Final, true, radiance);
    EXPECT_NEAR(radiance.at(110, 110).g, top.g / float(kPi), 0.01f * top.g);
    EXPECT_FALSE(pass(look_at_samples(baked, Layer::Volume, false, image), "volume view").ran);
    EXPECT_EQ(image.at(110, 110), Rgb(0.0f));
    EXPECT_FALSE(pass(look_at_samples(baked, Layer::Direct, true, image), "volume view").ran);
}

TEST(VolumeView, samples_that_a_wall_parts_stand_aside) {
    // Two cells, side by side along x, that share no record: as if a wall stood between them.
    IrradianceVolume volume = volume_of(Vec3(0), {2, 1, 1}, [](int, int, int) { return 1.0f; });
    VolumeTree& tree = volume.tree;
    for (int corner = 0; corner < 8; corner += 2) {
        glsl::VolumeCell& right = tree.cells[1];
        (corner < 4 ? right.low[corner] : right.high[corner - 4]) = tree.samples++;
    }
    const std::vector<Vec4> spheres = sample_spheres(tree);
    ASSERT_EQ(spheres.size(), 16u);
    EXPECT_LT(spheres[1].x, 1.0f - 0.9f * spheres[1].w);
    EXPECT_GT(spheres[12].x, 1.0f + 0.9f * spheres[12].w);
    EXPECT_EQ(spheres[12].w, 0.04f);
}

}  // namespace
}  // namespace daylit
