// How much light a Phong lobe reflects, against quadrature of the lobe.
#include "shaders/shared/brdf.h"

#include <gtest/gtest.h>

#include <array>

#include "engine/base/units.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

/// (n + 2) / (2 pi) * integral over the hemisphere of cos(angle to the mirrored view)^n * cosine: midpoint rule over
/// the lobe.
double albedo_by_quadrature(double exponent, double cos_view) {
    constexpr int kSteps = 400;
    const double sin_view = std::sqrt(1.0 - cos_view * cos_view);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double z = std::pow((i + 0.5) / kSteps, 1.0 / (exponent + 1.0)), s = std::sqrt(1.0 - z * z);
        for (int j = 0; j < kSteps; ++j)
            sum += std::max(0.0, z * cos_view + s * std::cos(2.0 * kPi * (j + 0.5) / kSteps) * sin_view);
    }
    return (exponent + 2.0) / (exponent + 1.0) * sum / (kSteps * kSteps);
}

TEST(Brdf, PhongDirectionalAlbedoIsThatOfItsLobe) {
    for (const float exponent : {0.5f, 1.0f, 3.0f, 10.0f, 100.0f, 3000.0f})
        for (const float cos_view : {0.0f, 0.1f, 0.3f, 0.6f, 0.9f, 1.0f})
            EXPECT_NEAR(glsl::phong_directional_albedo(exponent, cos_view), albedo_by_quadrature(exponent, cos_view),
                        0.02)
                << exponent << " " << cos_view;
    EXPECT_EQ(glsl::phong_directional_albedo(0.0f, 0.2f), 1.0f);
}

TEST(Brdf, PhongMeanAlbedoIsTheMeanOverViews) {
    for (const float exponent : {0.5f, 2.0f, 30.0f, 1000.0f}) {
        double sum = 0.0;
        constexpr int kSteps = 1000;
        for (int i = 0; i < kSteps; ++i) {
            const double c = (i + 0.5) / kSteps;
            sum += 2.0 * c * glsl::phong_directional_albedo(exponent, float(c)) / kSteps;
        }
        EXPECT_NEAR(glsl::phong_mean_albedo(exponent), sum, 1e-4) << exponent;
    }
}

// The mean of each basis function over the lobe, about a direction where none of them is zero.
TEST(Brdf, BandsOfAPhongLobeAreItsMeans) {
    const Vec3 about = glm::normalize(Vec3(0.3f, 0.5f, 0.7f)), x = glm::normalize(glm::cross(about, Vec3(0, 1, 0))),
               y = glm::cross(about, x);
    for (const float exponent : {0.5f, 3.0f, 40.0f}) {
        constexpr int kSteps = 300;
        std::array<double, 9> mean{};
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const float z = std::pow((float(i) + 0.5f) / kSteps, 1.0f / (exponent + 1.0f)),
                            s = std::sqrt(1.0f - z * z);
                const float turn = 2.0f * float(kPi) * (float(j) + 0.5f) / kSteps;
                const glsl::Sh9 basis = glsl::sh_basis(z * about + s * (std::cos(turn) * x + std::sin(turn) * y));
                for (std::size_t k = 0; k < 9; ++k) mean[k] += basis.c[k] / (kSteps * kSteps);
            }
        const glsl::Sh9 weights = glsl::sh_lobe_weights(about, exponent);
        for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(weights.c[k], mean[k], 1e-3) << exponent << " " << k;
    }
}

}  // namespace
}  // namespace daylit
