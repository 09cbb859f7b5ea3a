// Light on one side of a wall stays there, and nothing pops on the way through a door.
#include <gtest/gtest.h>

#include <cmath>

#include "volume_scenes.h"

namespace daylit {
namespace {

constexpr float kBright = 1000.0f, kDark = 1.0f;  // of the two rooms' ceilings, cd/m^2
const Vec3 kRoom(3.0f, 2.6f, 3.0f);

/// Two rooms side by side along x, each under a ceiling that shines, and between them a wall this thick, from wall to
/// wall but for a door.
TestScene two_rooms(float thick, float door) {
    TestScene made;
    const std::uint32_t wall = made.add(lambert(Rgb(0.6f)));
    const Vec3 size(2.0f * kRoom.x + thick, kRoom.y, kRoom.z), x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
    made.quad(wall, Vec3(0.0f), z, x);
    made.quad(wall, Vec3(0.0f), y, z);
    made.quad(wall, x, z, y);
    made.quad(wall, Vec3(0.0f), x, y);
    made.quad(wall, z, y, x);
    const Vec3 half(kRoom.x, 0, 0), beyond(kRoom.x + thick, 0, 0);
    made.quad(made.add(lambert(Rgb(0.6f), Rgb(kBright))), y, half, z);
    made.quad(made.add(lambert(Rgb(0.6f), Rgb(kDark))), y + beyond, half, z);
    if (door > 0.0f) {
        const Vec3 high(kRoom.x, 2.0f, 0);
        made.box(wall, half, half + Vec3(thick, 2.0f, 0.5f * (size.z - door)));
        made.box(wall, half + Vec3(0, 0, 0.5f * (size.z + door)), half + Vec3(thick, 2.0f, size.z));
        made.box(wall, high, high + Vec3(thick, size.y - high.y, size.z));
    } else {
        made.box(wall, half, half + Vec3(thick, size.y, size.z));
    }
    return made;
}

Baked bake_rooms(const TestScene& rooms, double error) {
    BakeSettings settings = one_hour();
    settings.error = error;
    settings.parts = {"volume"};
    return bake(with_plates(rooms, {Vec3(1.5f, 1.2f, 1.5f), Vec3(4.5f, 1.2f, 1.5f)}), settings);
}

constexpr double kPreview = 0.1, kMedium = 0.03;  // errors of bakes
// Of the truth: with 1024 its own noise was most of what was found.
constexpr int kPaths = 16384;

/// Errors in the dark room five centimetres from the wall, over the mean light there, and the worst over its own truth.
struct Leak {
    double worst = 0.0, rms = 0.0, own = 0.0;
};

Leak leak(float thick) {
    TestScene rooms = two_rooms(thick, 0.0f);
    const Baked baked = bake_rooms(rooms, kMedium);
    EXPECT_TRUE(baked.volume);
    std::vector<SurfaceSample> points;
    for (const float y : {0.3f, 1.1f, 2.3f})
        for (const float z : {0.2f, 1.6f, 2.5f})
            for (const Vec3& normal : kNormals) points.push_back({Vec3(kRoom.x + thick + 0.05f, y, z), normal});
    const std::vector<Rgb> expected =
        path_trace_irradiance(rooms.trace(), no_light(), {}, points, {.spp = kPaths, .layer = Layer::Indirect});
    double mean = 0.0, squares = 0.0, worst = 0.0, own = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        mean += double(expected[i].g) / double(points.size());
        const double wrong = double(at(baked, points[i].position, points[i].normal).g) - double(expected[i].g);
        squares += wrong * wrong / double(points.size());
        worst = std::max(worst, std::abs(wrong)), own = std::max(own, std::abs(wrong) / double(expected[i].g));
    }
    std::printf("wall of %g m: RMS %.3f, worst %.3f of the dark side's mean %.3g lux, %.3f of its own truth\n",
                double(thick), std::sqrt(squares) / mean, worst / mean, mean, own);
    return {worst / mean, std::sqrt(squares) / mean, own};
}

// The other side is a thousand times as bright.
TEST(VolumeLeak, next_to_nothing_comes_through_a_wall_of_ten_centimetres) {
    const Leak found = leak(0.10f);
    EXPECT_LT(found.rms, 0.02);
    EXPECT_LT(found.worst, 0.05);
    EXPECT_LT(found.own, 0.05);
}

// Thinner than the floor's texels, which are parted where they lie across the foot of the wall.
TEST(VolumeLeak, next_to_nothing_comes_through_a_wall_thinner_than_texels) {
    const Leak found = leak(0.02f);
    EXPECT_LT(found.rms, 0.02);
    EXPECT_LT(found.worst, 0.05);
    EXPECT_LT(found.own, 0.05);
}

/// Largest change over a millimetre against the larger of the changes before and after, on a straight path.
double worst_step(const Baked& baked, const Vec3& from, const Vec3& to) {
    const std::vector<Rgb> weights = baked.volume->basis.weights(LightModel(baked.light, {}).scales(12.0, 0.0), 12.0);
    const VolumeLight light(*baked.volume, weights);
    const int steps = int(glm::distance(from, to) / 0.001f);
    std::vector<double> value;
    for (int i = 0; i <= steps; ++i)
        value.push_back(double(light.irradiance(glm::mix(from, to, float(i) / float(steps)), Vec3(0, 1, 0)).g));
    double worst = 0.0;
    for (std::size_t i = 2; i + 1 < value.size(); ++i) {
        const auto change = [&](std::size_t at) { return std::abs(value[at] - value[at - 1]); };
        const double rounding = 1e-5 * value[i];
        worst = std::max(worst, (change(i) - rounding) / (std::max(change(i - 1), change(i + 1)) + rounding));
    }
    return worst;
}

TEST(VolumeLeak, nothing_pops_on_twenty_ways_through_a_door) {
    const Baked baked = bake_rooms(two_rooms(0.10f, 1.0f), kPreview);
    ASSERT_TRUE(baked.volume);
    double worst = 0.0;
    for (int way = 0; way < 20; ++way) {
        const float z = 1.1f + 0.2f * float(way % 5), y = 0.3f + 0.4f * float(way / 5);
        worst = std::max(worst, worst_step(baked, Vec3(0.4f, y, z), Vec3(5.7f, 0.9f, 1.2f + 0.15f * float(way % 5))));
    }
    std::printf("largest step over its neighbours' %.2f\n", worst);
    EXPECT_LT(worst, 3.0);
}

}  // namespace
}  // namespace daylit
