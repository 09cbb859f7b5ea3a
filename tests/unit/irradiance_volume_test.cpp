// Look-ups in an irradiance volume whose answers are known on paper.
#include "engine/baked/irradiance_volume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/baked/volume_batch.h"
#include "shaders/shared/sh.h"
#include "tests/support/volume_builder.h"

namespace daylit {
namespace {

using glsl::kShCoefficients;

const std::vector<Vec3> kNormals = {Vec3(1, 0, 0),
                                    Vec3(0, 1, 0),
                                    Vec3(0, 0, 1),
                                    Vec3(-1, 0, 0),
                                    Vec3(0, -1, 0),
                                    Vec3(0, 0, -1),
                                    glm::normalize(Vec3(1, 2, 3)),
                                    glm::normalize(Vec3(-2, 1, -0.5f))};

/// One cell of a metre from (1, 2, 3) on; value(record, coefficient).
template <class Value>
IrradianceVolume cell_of(const Value& value) {
    return volume_of(Vec3(1, 2, 3), {1, 1, 1}, [&](int record, int i, int) { return value(record, i); });
}

/// Numeric sums over the sphere, exact for these low degrees to about 1e-5.
template <class F>
double over_sphere(const F& f) {
    constexpr int kRows = 400, kColumns = 16;
    double sum = 0.0;
    for (int i = 0; i < kRows; ++i)
        for (int j = 0; j < kColumns; ++j) {
            const double z = 2.0 * (i + 0.5) / kRows - 1.0, phi = 2.0 * kPi * (j + 0.5) / kColumns,
                         r = std::sqrt(1 - z * z);
            sum += f(Vec3(r * std::cos(phi), r * std::sin(phi), z)) * 4.0 * kPi / (kRows * kColumns);
        }
    return sum;
}

TEST(SphericalHarmonics, are_orthonormal) {
    for (int a = 0; a < kShCoefficients; ++a)
        for (int b = 0; b <= a; ++b)
            EXPECT_NEAR(
                over_sphere([&](const Vec3& d) { return double(glsl::sh_basis(d).c[a]) * glsl::sh_basis(d).c[b]; }),
                a == b ? 1.0 : 0.0, 1e-4)
                << a << " " << b;
}

// Y1 grows along +y, +z, +x: no Condon-Shortley sign.
TEST(SphericalHarmonics, have_their_documented_order_and_signs) {
    EXPECT_GT(glsl::sh_basis(Vec3(0, 1, 0)).c[1], 0.0f);
    EXPECT_GT(glsl::sh_basis(Vec3(0, 0, 1)).c[2], 0.0f);
    EXPECT_GT(glsl::sh_basis(Vec3(1, 0, 0)).c[3], 0.0f);
    EXPECT_GT(glsl::sh_basis(glm::normalize(Vec3(1, 1, 0))).c[4], 0.0f);
    EXPECT_GT(glsl::sh_basis(glm::normalize(Vec3(1, 0, 1))).c[7], 0.0f);
}

// L is the same from everywhere: its one coefficient is L sqrt(4 pi), and E = pi L on every plane.
TEST(IrradianceVolume, constant_light_gives_pi_l_on_every_plane) {
    const double radiance = 100.0;
    const auto volume = cell_of([&](int, int i) { return i == 0 ? float(radiance * std::sqrt(4.0 * kPi)) : 0.0f; });
    for (const Vec3& n : kNormals)
        EXPECT_NEAR(light_of(volume).irradiance(Vec3(1.3f, 2.6f, 3.9f), n).g, kPi * radiance, 0.001 * kPi * radiance);
}

// L(d) = 1 + d.a: E(n) = pi + 2 pi / 3 n.a (the cosine integrated over the hemisphere).
TEST(IrradianceVolume, light_that_grows_along_an_axis) {
    const Vec3 axis = glm::normalize(Vec3(1, -2, 2));
    std::array<double, 9> sh{};
    for (int i = 0; i < kShCoefficients; ++i)
        sh[std::size_t(i)] =
            over_sphere([&](const Vec3& d) { return (1.0 + glm::dot(d, axis)) * glsl::sh_basis(d).c[i]; });
    const auto volume = cell_of([&](int, int i) { return float(sh[std::size_t(i)]); });
    for (const Vec3& n : kNormals)
        EXPECT_NEAR(light_of(volume).irradiance(Vec3(1.5f), n).r, kPi + 2.0 * kPi / 3.0 * glm::dot(n, axis), 0.01);
}

// Without changes at corners Adini's blend is 3 u^2 - 2 u^3 along an edge; beside the cell the border holds.
TEST(IrradianceVolume, blends_corners_and_holds_the_border) {
    const auto volume =
        cell_of([](int p, int i) { return i == 0 ? float(p) : 0.0f; });  // 1 along x, 2 along y, 4 along z
    const VolumeLight light = light_of(volume);
    const double unit = kPi * 0.282094792;
    const auto at = [&](const Vec3& place) { return light.irradiance(place, Vec3(0, 1, 0)).b / unit; };
    EXPECT_NEAR(at({1, 2, 3}), 0.0, 1e-6);
    EXPECT_NEAR(at({2, 3, 4}), 7.0, 1e-5);
    EXPECT_NEAR(at({1.25f, 2, 3}), 3 * 0.0625 - 2 * 0.015625, 1e-5);
    EXPECT_NEAR(at({1.5f, 2.5f, 3.5f}), 3.5, 1e-5);
    EXPECT_NEAR(at({-50, 100, 3.5f}), 0.0 + 2.0 + 2.0, 1e-5);
}

// A change of 2 per metre along x, stored in steps, makes light linear there.
TEST(IrradianceVolume, changes_at_corners_count) {
    auto volume = cell_of([](int p, int i) { return i == 0 ? float(2 * (p & 1)) : 0.0f; });
    volume.change_step.assign(24, 2.0f / 127.0f);
    for (int i = 0; i < 3; ++i)
        for (std::size_t s = 0; s < 8; ++s) volume.changes[std::size_t(i) * 8 + s] = 127;
    const VolumeLight light = light_of(volume);
    for (const float x : {0.0f, 0.2f, 0.7f, 1.0f})
        EXPECT_NEAR(light.irradiance(Vec3(1 + x, 2.4f, 3.1f), Vec3(0, 1, 0)).g, 2.0 * double(x) * kPi * 0.282094792,
                    1e-4);
}

TEST(IrradianceVolume, is_never_negative) {
    // Light from above, "less than none" from below.
    const auto volume = cell_of([](int, int i) { return i == 1 ? 1.0f : 0.0f; });
    EXPECT_GT(light_of(volume).irradiance(Vec3(1.5f), Vec3(0, 1, 0)).r, 0.9f);
    EXPECT_EQ(light_of(volume).irradiance(Vec3(1.5f), Vec3(0, -1, 0)), Rgb(0.0f));
}

// As cubics swing beside a bright opening: the mean is right, and one side falls short of nothing.
TEST(IrradianceVolume, is_not_black_where_there_is_light) {
    const auto volume = cell_of([](int, int i) { return i == 0 ? 1.0f : i == 1 ? 2.0f : 0.0f; });
    const double mean = kPi * 0.282094792;
    const VolumeLight light = light_of(volume);
    const std::vector<Vec3> places(2, Vec3(1.5f)), normals = {Vec3(0, -1, 0), Vec3(0, 1, 0)};
    std::vector<Rgb> batch(2);
    VolumeBatch(light).irradiance(places, normals, batch);
    for (const double below : {double(light.irradiance(places[0], normals[0]).g), double(batch[0].g)}) {
        EXPECT_GT(below, 0.02 * mean);
        EXPECT_LT(below, 0.1 * mean);
    }
    EXPECT_GT(batch[1].g, 2.0 * mean);
}

TEST(IrradianceVolume, sums_its_components_each_with_its_colour) {
    auto volume = cell_of([](int, int i) { return i == 0 ? 2.0f : 0.0f; });
    const std::vector<std::int16_t> values = volume.values;
    volume.basis.components = 2;
    volume.values.insert(volume.values.end(), values.begin(), values.end());
    volume.changes.resize(2 * volume.changes.size(), 0);
    const VolumeLight light(volume, std::vector<Rgb>{Rgb(2, 0, 1), Rgb(5, 1, 0)});
    const double unit = kPi * 0.282094792 * 2.0;
    const Rgb found = light.irradiance(Vec3(1.5f), Vec3(1, 0, 0));
    EXPECT_NEAR(found.r, 7.0 * unit, 1e-4);
    EXPECT_NEAR(found.g, 1.0 * unit, 1e-4);
    EXPECT_NEAR(found.b, 1.0 * unit, 1e-4);
}

TEST(IrradianceVolume, many_places_at_once_are_as_each_alone) {
    const auto volume = volume_of(Vec3(0.0f), {2, 1, 3},
                                  [](int p, int i, int c) { return i == 0 ? 20 + p : 0.1f * float(p % 5 - i - c); });
    const VolumeLight light = light_of(volume);
    std::vector<Vec3> places, normals;
    for (int i = 0; i < 100; ++i) {  // not a multiple of what is summed at once, and beyond the border
        places.push_back(Vec3(0.02f * float(i), 0.9f - 0.04f * float(i % 20), 0.035f * float(i)));
        normals.push_back(kNormals[std::size_t(i) % kNormals.size()]);
    }
    std::vector<Rgb> all(places.size());
    std::vector<TwoSided> both(places.size());
    const VolumeBatch batch(light);
    batch.irradiance(places, normals, all);
    batch.two_sided(places, normals, both);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Rgb alone = light.irradiance(places[i], normals[i]), back = light.irradiance(places[i], -normals[i]);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(all[i][c], alone[c], 1e-5f * alone[c]) << i;
            EXPECT_NEAR(both[i].front[c], alone[c], 1e-5f * std::max(alone[c], back[c])) << i;
            EXPECT_NEAR(both[i].back[c], back[c], 1e-5f * std::max(alone[c], back[c])) << i;
        }
    }
}

}  // namespace
}  // namespace daylit
