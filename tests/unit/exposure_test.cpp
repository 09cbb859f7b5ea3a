#include "engine/base/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daylit {
namespace {

TEST(Exposure, an_even_picture_is_metered_by_the_formula) {
    // 4096 cd/m^2 * 100 / 12.5 = 2^15.
    EXPECT_NEAR(auto_ev(Image(10, 10, Rgb(4096.0f))), 15.0, 1e-5);
    EXPECT_NEAR(auto_ev(Image(1, 1, Rgb(4096.0f))), 15.0, 1e-5);
}

TEST(Exposure, a_tenth_at_either_end_does_not_count) {
    Image image(10, 10, Rgb(4096.0f));
    for (int x = 0; x < 10; ++x) {
        image.at(x, 0) = Rgb(1e9f);
        image.at(x, 1) = Rgb(0.01f);
    }
    EXPECT_NEAR(auto_ev(image), 15.0, 1e-5);
}

TEST(Exposure, black_empty_and_broken_pictures_give_the_floor) {
    const double floor = -3.0;
    EXPECT_NEAR(auto_ev(Image(4, 4)), floor, 1e-5);
    EXPECT_NEAR(auto_ev(Image(4, 4, Rgb(0.001f))), floor, 1e-5);
    EXPECT_NEAR(auto_ev(Image()), floor, 1e-5);
    EXPECT_NEAR(auto_ev(Image(4, 4, Rgb(std::numeric_limits<float>::quiet_NaN()))), floor, 1e-5);
}

TEST(Exposure, saturation_is_at_1_2_times_2_to_the_ev) {
    EXPECT_NEAR(exposure_from_ev(3.0) * 9.6, 1.0, 1e-12);
}

TEST(Exposure, the_displayed_picture_lies_in_0_to_1_and_grows_with_the_light) {
    Image image(64, 1);
    for (int x = 0; x < 64; ++x) image.at(x, 0) = Rgb(std::exp2(float(x) - 20.0f));
    const Image shown = tonemap(image, 10.0);
    for (int x = 0; x < 64; ++x) {
        EXPECT_GE(shown.at(x, 0).g, x == 0 ? 0.0f : shown.at(x - 1, 0).g);
        EXPECT_LE(shown.at(x, 0).g, 1.0f);
    }
    EXPECT_GT(shown.at(63, 0).g, 0.99f);
}

}  // namespace
}  // namespace daylit
