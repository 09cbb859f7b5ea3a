// Components over time: exact at full rank, and as wrong as it says when cut short.
#include "gi/encode/time_basis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.h"

namespace daylit {
namespace {

constexpr std::size_t kKeyframes = 5, kRows = 400;

/// Rows of independent random light; keyframe 4 is a thousand times darker, as dusk is.
DayRows random_rows() {
    DayRows rows;
    rows.count = kRows;
    rows.hours = {6, 9, 12, 15, 21};
    rows.exposure = {100, 1000, 1000, 500, 1};
    rows.read = [exposure = rows.exposure](std::size_t row, Rgb* keyframes) {
        Random random(3, row, 0);
        for (std::size_t k = 0; k < kKeyframes; ++k) {
            const float r = random.next(), g = random.next(), b = random.next();
            keyframes[k] = float(exposure[k]) * Rgb(r, g, b);
        }
    };
    return rows;
}

/// What the runtime shows for a row at a keyframe's hour.
Rgb shown(const TimeBasis& basis, const DayBasis& curves, const DayRows& rows, std::size_t row, std::size_t keyframe) {
    std::vector<Rgb> light(kKeyframes), components(std::size_t(basis.components) + 1);
    rows.read(row, light.data());
    project(basis, light.data(), components.data());
    const std::vector<float> weights = curves.weights(rows.hours[keyframe]);
    Rgb sum(0.0f);
    for (std::size_t r = 0; r < weights.size(); ++r) sum += weights[r] * components[r];
    return sum;
}

TEST(TimeBasis, FullRankIsExactAtEveryKeyframe) {
    const DayRows rows = random_rows();
    const TimeBasis basis = fit_time_basis(rows, {.max_components = 8, .error = 0.0});
    ASSERT_EQ(basis.components, int(kKeyframes));
    EXPECT_LT(basis.error, 1e-6);
    const DayBasis curves = day_basis(basis, std::vector<float>(kKeyframes, 1.0f));
    std::vector<Rgb> light(kKeyframes);
    for (std::size_t row = 0; row < kRows; row += 37) {
        rows.read(row, light.data());
        for (std::size_t k = 0; k < kKeyframes; ++k)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(shown(basis, curves, rows, row, k)[c], light[k][c], 1e-5 * rows.exposure[k]);
    }
}

TEST(TimeBasis, LightThatOnlyDimsTakesOneComponent) {
    DayRows rows = random_rows();
    rows.read = [exposure = rows.exposure](std::size_t row, Rgb* keyframes) {
        for (std::size_t k = 0; k < kKeyframes; ++k) keyframes[k] = float(exposure[k]) * Rgb(float(row + 1), 1.0f, 0.5f);
    };
    EXPECT_EQ(fit_time_basis(rows, {.max_components = 8, .error = 1e-3}).components, 1);
}

TEST(TimeBasis, CutShortItIsAsWrongAsItSays) {
    const DayRows rows = random_rows();
    const TimeBasis basis = fit_time_basis(rows, {.max_components = 3, .error = 0.0});
    ASSERT_EQ(basis.components, 3);
    const std::vector<float> ones(3, 1.0f);
    const DayBasis curves = day_basis(basis, ones);
    const double measured = measure_error(rows, curves, [&](std::size_t row, std::span<const float> weights) {
        std::vector<Rgb> light(kKeyframes), components(3);
        rows.read(row, light.data());
        project(basis, light.data(), components.data());
        Rgb sum(0.0f);
        for (std::size_t r = 0; r < 3; ++r) sum += weights[r] * components[r];
        return sum;
    });
    EXPECT_GT(basis.error, 0.05);
    EXPECT_NEAR(measured, basis.error, 1e-4);
}

TEST(TimeBasis, DuskCountsAsMuchAsNoon) {
    // Two independent patterns, one of them a thousand times darker in absolute terms: both are kept.
    DayRows rows = random_rows();
    rows.exposure = {1, 1, 1, 1, 0.001};
    rows.read = [](std::size_t row, Rgb* keyframes) {
        const float day = float(row % 2), night = float(row / 2 % 2);
        for (std::size_t k = 0; k < kKeyframes; ++k) keyframes[k] = Rgb(k == 4 ? 0.001f * night : day) + Rgb(1e-4f);
    };
    const TimeBasis basis = fit_time_basis(rows, {.max_components = 2, .error = 0.0});
    EXPECT_LT(basis.error, 0.15);
}

TEST(TimeBasis, BlackTakesNoComponents) {
    DayRows rows = random_rows();
    rows.read = [](std::size_t, Rgb* keyframes) { std::fill_n(keyframes, kKeyframes, Rgb(0.0f)); };
    const TimeBasis basis = fit_time_basis(rows, {});
    EXPECT_EQ(basis.components, 0);
    EXPECT_EQ(basis.error, 0.0);
}

}  // namespace
}  // namespace daylit
