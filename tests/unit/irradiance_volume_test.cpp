// Look-ups in an irradiance volume whose answers are known on paper.
#include "engine/baked/irradiance_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "shaders/shared/sh.h"

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

/// 2 x 2 x 2 probes a metre apart from (1, 2, 3) on; value(probe, coefficient) of the one component.
template <class Value>
IrradianceVolume volume_of(const Value& value) {
    IrradianceVolume volume;
    volume.origin = Vec3(1, 2, 3);
    volume.size = {2, 2, 2};
    volume.basis = {{12.0}, 1, {1.0f}};
    for (int i = 0; i < kShCoefficients; ++i)
        for (int probe = 0; probe < 8; ++probe)
            for (int c = 0; c < 3; ++c) volume.components.push_back(glm::packHalf1x16(value(probe, i)));
    return volume;
}

const std::vector<float> kOne = {1.0f};

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
    const auto volume = volume_of([&](int, int i) { return i == 0 ? float(radiance * std::sqrt(4.0 * kPi)) : 0.0f; });
    for (const Vec3& n : kNormals)
        EXPECT_NEAR(volume.irradiance(Vec3(1.3f, 2.6f, 3.9f), n, kOne).g, kPi * radiance, 0.001 * kPi * radiance);
}

// L(d) = 1 + d.a: E(n) = pi + 2 pi / 3 n.a (the cosine integrated over the hemisphere).
TEST(IrradianceVolume, light_that_grows_along_an_axis) {
    const Vec3 axis = glm::normalize(Vec3(1, -2, 2));
    std::array<double, 9> sh{};
    for (int i = 0; i < kShCoefficients; ++i)
        sh[std::size_t(i)] =
            over_sphere([&](const Vec3& d) { return (1.0 + glm::dot(d, axis)) * glsl::sh_basis(d).c[i]; });
    const auto volume = volume_of([&](int, int i) { return float(sh[std::size_t(i)]); });
    for (const Vec3& n : kNormals)
        EXPECT_NEAR(volume.irradiance(Vec3(1.5f), n, kOne).r, kPi + 2.0 * kPi / 3.0 * glm::dot(n, axis), 0.01);
}

TEST(IrradianceVolume, mixes_probes_trilinearly_and_holds_the_border) {
    // Probe p has light p: 1 along x, 2 along y, 4 along z.
    const auto volume = volume_of([](int p, int i) { return i == 0 ? float(p) : 0.0f; });
    const double unit = kPi * 0.282094792;
    const auto at = [&](const Vec3& place) { return volume.irradiance(place, Vec3(0, 1, 0), kOne).b / unit; };
    EXPECT_NEAR(at({1, 2, 3}), 0.0, 1e-6);
    EXPECT_NEAR(at({2, 3, 4}), 7.0, 1e-5);
    EXPECT_NEAR(at({1.25f, 2.5f, 3.75f}), 0.25 + 2 * 0.5 + 4 * 0.75, 1e-5);
    EXPECT_NEAR(at({-50, 100, 3.5f}), 0.0 + 2.0 + 2.0, 1e-5);
}

TEST(IrradianceVolume, is_never_negative) {
    const auto volume =
        volume_of([](int, int i) { return i == 1 ? 1.0f : 0.0f; });  // light from above, "less than none" from below
    EXPECT_GT(volume.irradiance(Vec3(1.5f), Vec3(0, 1, 0), kOne).r, 0.9f);
    EXPECT_EQ(volume.irradiance(Vec3(1.5f), Vec3(0, -1, 0), kOne), Rgb(0.0f));
}

TEST(IrradianceVolume, sums_its_components) {
    auto volume = volume_of([](int, int i) { return i == 0 ? 2.0f : 0.0f; });
    volume.basis = {{6.0, 18.0}, 2, {1.0f, 3.0f, 0.0f, 10.0f}};
    const std::vector<std::uint16_t> first = volume.components;
    volume.components.insert(volume.components.end(), first.begin(), first.end());
    const auto weights = volume.basis.weights(12.0);
    ASSERT_EQ(weights, (std::vector<float>{2.0f, 5.0f}));
    const double expected = kPi * 0.282094792 * 2.0 * (2.0 + 5.0);
    EXPECT_NEAR(volume.irradiance(Vec3(1.5f), Vec3(1, 0, 0), weights).r, expected, 1e-4);
    EXPECT_NEAR(volume.combined(weights)[3].r, 14.0f, 1e-5);
    EXPECT_EQ(volume.combined(weights)[8].r, 0.0f);
}

}  // namespace
}  // namespace daylit
