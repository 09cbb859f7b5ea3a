// Weights of light's parts at any hour.
#include "engine/baked/light_basis.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daylit {
namespace {

/// Keyframes at uneven hours; one component whose columns are functions of the hour.
LightBasis basis_of(double (*sun)(double), double (*sky)(double)) {
    LightBasis basis;
    basis.hours = {4.0, 5.0, 5.5, 6.5, 8.0, 10.0, 12.0};
    basis.suns = basis.skies = basis.hours.size();
    basis.components = 1;
    for (double h : basis.hours) basis.curves.push_back(float(sun(h)));
    for (double h : basis.hours) {
        basis.curves.push_back(1.0f);
        basis.sky_level.push_back(float(sky(h)));
    }
    for (float still : {2.0f, 3.0f, 5.0f, 7.0f, 11.0f}) basis.curves.push_back(still);
    return basis;
}

const LightScales kSun = {.sun = Rgb(1.0f), .evening = 0.0f};

TEST(LightBasis, EveryPartHasItsOwnScale) {
    const LightBasis basis = basis_of([](double) { return 13.0; }, [](double) { return 17.0; });
    const LightScales scales = {.sun = Rgb(1, 2, 3),
                                .clear = 0.5f,
                                .overcast = Rgb(10, 20, 30),
                                .ground = Rgb(100, 0, 0),
                                .night = 1000.0f,
                                .evening = 10000.0f};
    const Rgb sum = Rgb(13, 26, 39) + Rgb(8.5f) + Rgb(20, 40, 60) + Rgb(300, 0, 0) + Rgb(5000 + 70000 + 11);
    const Rgb found = basis.weights(scales, 9.0)[0];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], sum[c], 1e-6f * sum[c]);
}

TEST(LightBasis, FollowsParabolasBetweenUnevenKeyframes) {
    const LightBasis basis = basis_of([](double h) { return 1.0 + h * h; }, [](double) { return 1.0; });
    // Inside; the first and last interval have no neighbour to take a tangent from.
    for (double hour = 5.0; hour < 10.0; hour += 0.07)
        EXPECT_NEAR(basis.weights(kSun, hour)[0].x - 11.0, 1.0 + hour * hour, 1e-4) << hour;
}

TEST(LightBasis, TheSkysLevelMayFallByDecades) {
    const LightBasis basis = basis_of([](double) { return 0.0; }, [](double h) { return std::pow(10.0, h - 8.0); });
    const LightScales sky = {.clear = 1.0f, .evening = 0.0f};
    for (double hour = 5.0; hour < 10.0; hour += 0.07) {
        const double truth = std::pow(10.0, hour - 8.0);
        EXPECT_NEAR(basis.weights(sky, hour)[0].x - 11.0, truth, 1e-3 * truth + 1e-5) << hour;
    }
}

TEST(LightBasis, MeetsItsKeyframesAndHoldsOutside) {
    const LightBasis basis = basis_of([](double h) { return std::sin(7.0 * h); }, [](double) { return 1.0; });
    for (double hour : basis.hours) EXPECT_NEAR(basis.weights(kSun, hour)[0].x - 11.0, std::sin(7.0 * hour), 1e-5);
    EXPECT_EQ(basis.weights(kSun, 1.0), basis.weights(kSun, 4.0));
    EXPECT_EQ(basis.weights(kSun, 23.0), basis.weights(kSun, 12.0));
    EXPECT_EQ(basis.weights(kSun, 9.0 + 48.0), basis.weights(kSun, 9.0));
    EXPECT_EQ(basis.weights(kSun, -1e-30), basis.weights(kSun, 0.0));
}

TEST(LightBasis, OneColumnHoldsAllDay) {
    LightBasis basis;
    basis.hours = {6.0, 12.0};
    basis.suns = 1;
    basis.components = 1;
    basis.curves = {3.0f, 0, 0, 0, 0, 0};
    for (double hour : {0.0, 6.0, 8.0, 23.0}) EXPECT_EQ(basis.weights(kSun, hour)[0], Rgb(3.0f)) << hour;
}

TEST(CurveBlend, TwoKeyframesAreALine) {
    const std::vector<double> hours = {6.0, 8.0};
    const CurveBlend blend = curve_blend(hours, 6.5);
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) sum += blend.share[i] * (blend.keyframe[i] == 1 ? 1.0 : 0.0);
    EXPECT_NEAR(sum, 0.25, 1e-12);
}

}  // namespace
}  // namespace daylit
