// How much light a Phong lobe reflects, against quadrature of the lobe.
#include "shaders/shared/brdf.h"

#include <gtest/gtest.h>

namespace daylit {
namespace {

constexpr double kPi = 3.14159265358979;

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

}  // namespace
}  // namespace daylit
