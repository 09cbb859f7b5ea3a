// Differences of pictures and points: cases worked out by hand.
#include "engine/base/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/flip.h"
#include "engine/base/point_rows.h"
#include "engine/base/random.h"

namespace daylit {
namespace {

double mean(const std::vector<float>& values) {
    double sum = 0;
    for (const float v : values) sum += v;
    return sum / double(values.size());
}

Image noise(int width, int height, std::uint64_t seed) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        Random random(seed, i, 0);
        image.pixels[i] = Rgb(random.next(), random.next(), random.next());
    }
    return image;
}

TEST(Flip, IdenticalPicturesDoNotDiffer) {
    const Image image = noise(40, 30, 1);
    for (const float value : flip(image, image)) EXPECT_EQ(value, 0.0f);
}

TEST(Flip, SwappingPicturesChangesNothing) {
    const Image a = noise(40, 30, 1), b = noise(40, 30, 2);
    EXPECT_EQ(flip(a, b), flip(b, a));
}

TEST(Flip, BlackAgainstWhite) {
    // No features and no chroma: lightness differs by 100. 100^0.7 = 25.119; the largest difference is green to blue:
    // CIELAB of green (87.735, -86.183, 83.179) and of blue (32.297, 79.188, -107.860), chroma times L/100 gives
    // (-75.613, 72.978) and (25.575, -34.836), HyAB = 55.438 + sqrt(101.188^2 + 107.814^2) = 203.298, ^0.7 = 41.275.
    // Above the cut 0.4 * 41.275 = 16.510: 0.95 + 0.05 (25.119 - 16.510) / (41.275 - 16.510) = 0.96738.
    const std::vector<float> values = flip(Image(32, 32, Rgb(0.0f)), Image(32, 32, Rgb(1.0f)));
    for (const float value : values) EXPECT_NEAR(value, 0.96738, 1e-4);
}

TEST(Flip, GreenAgainstBlueIsTheLargestDifference) {
    const std::vector<float> values = flip(Image(32, 32, Rgb(0, 1, 0)), Image(32, 32, Rgb(0, 0, 1)));
    for (const float value : values) EXPECT_NEAR(value, 1.0, 1e-4);
}

TEST(Flip, GreysBelowTheCutScaleLinearly) {
    // Linear 0.18 and 0.20 are L* = 49.496 and 51.837: 2.341^0.7 = 1.8138, times 0.95 / 16.510 = 0.10437.
    const std::vector<float> values = flip(Image(24, 24, Rgb(0.18f)), Image(24, 24, Rgb(0.20f)));
    for (const float value : values) EXPECT_NEAR(value, 0.10437, 2e-4);
}

TEST(Flip, FineNoiseIsForgivenWithDistance) {
    // A checkerboard of single pixels against its mean in linear light: at 67 pixels a degree it nearly vanishes, at 5
    // pixels a degree it is plain. (The features alone keep the first from zero.)
    Image board(64, 64), flat(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            board.at(x, y) = Rgb((x + y) % 2 ? 0.25f : 0.15f);
            flat.at(x, y) = Rgb(0.2f);
        }
    }
    EXPECT_LT(mean(flip(board, flat, 67.0)), 0.3 * mean(flip(board, flat, 5.0)));
}

TEST(Flip, AnEdgeCountsMoreThanItsColoursAlone) {
    Image step(64, 64), moved(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            step.at(x, y) = Rgb(x < 32 ? 0.1f : 0.6f);
            moved.at(x, y) = Rgb(x < 36 ? 0.1f : 0.6f);
        }
    }
    const std::vector<float> values = flip(step, moved);
    EXPECT_GT(values[32 * 64 + 34], 0.6f);  // the plain colours' difference is about 0.66
    EXPECT_LT(values[32 * 64 + 5], 1e-3f);
    EXPECT_LT(values[32 * 64 + 60], 1e-3f);
}

TEST(Flip, NanCountsAsBlack) {
    Image a(16, 16, Rgb(0.0f)), b(16, 16, Rgb(0.0f));
    a.at(3, 3) = Rgb(std::numeric_limits<float>::quiet_NaN());
    for (const float value : flip(a, b)) EXPECT_EQ(value, 0.0f);
    EXPECT_EQ(flip(Image(1, 1, Rgb(0.5f)), Image(1, 1, Rgb(0.5f))).size(), 1u);
}

TEST(Compare, NumbersByHand) {
    // Nine values of 1 and of 2, three of 3 against 5: squares 9 * 1 + 3 * 4 = 21 over 12.
    const std::vector<Rgb> a = {Rgb(2), Rgb(2), Rgb(2), Rgb(3)}, b = {Rgb(1), Rgb(1), Rgb(1), Rgb(5)};
    const Differences d = differences(a, b);
    EXPECT_DOUBLE_EQ(d.mse, 21.0 / 12.0);
    EXPECT_DOUBLE_EQ(d.rmse, std::sqrt(21.0 / 12.0));
    EXPECT_DOUBLE_EQ(d.nrmse, std::sqrt(21.0 / 12.0) / 2.0);
    EXPECT_DOUBLE_EQ(d.bias, 2.25 / 2.0 - 1.0);
    EXPECT_DOUBLE_EQ(d.max_abs, 2.0);
    EXPECT_DOUBLE_EQ(d.p95, 2.0 / 2.0);
    EXPECT_EQ(d.nan_count, 0u);
}

TEST(Compare, NotANumberIsCountedAndLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Rgb> a = {Rgb(nan, 2, 2), Rgb(2)}, b = {Rgb(1), Rgb(INFINITY, 1, 1)};
    const Differences d = differences(a, b);
    EXPECT_EQ(d.nan_count, 2u);
    EXPECT_DOUBLE_EQ(d.rmse, 1.0);
    EXPECT_DOUBLE_EQ(d.bias, 1.0);
}

TEST(Compare, BlackAgainstBlackIsNoDifference) {
    const std::vector<Rgb> black(4, Rgb(0.0f));
    const Differences d = differences(black, black);
    EXPECT_EQ(d.nrmse, 0.0);
    EXPECT_EQ(d.bias, 0.0);
    EXPECT_EQ(d.p95, 0.0);
}

TEST(Compare, YeeSeesAPatchAndNothingInEqualPictures) {
    Image a(64, 64, Rgb(0.2f)), b = a;
    EXPECT_EQ(displayed_differences(a, b).yee_failed, 0u);
    EXPECT_EQ(displayed_differences(a, b).max_abs_8bit, 0);
    for (int y = 16; y < 48; ++y) {
        for (int x = 16; x < 48; ++x) b.at(x, y) = Rgb(0.8f);
    }
    const DisplayedDifferences d = displayed_differences(a, b);
    EXPECT_GT(d.yee_failed, 900u);  // the patch is 1024 pixels
    EXPECT_LT(d.yee_failed, 1500u);
    EXPECT_NEAR(d.max_abs_8bit, 255 * (0.9063 - 0.4845), 1.0);  // sRGB codes of 0.8 and 0.2
    EXPECT_GT(d.flip_p95, 0.5);
}

TEST(Compare, YeeForgivesWhatIsBelowTheThreshold) {
    // Adapted to 20 cd/m^2 the threshold is 10^((0.249 log10(20) + 0.65)^2.7 - 0.72) = 1.63 cd/m^2; no contrast, so no
    // masking. A display white of 100 cd/m^2 makes that 0.0163 of linear light.
    const Image grey(32, 32, Rgb(0.2f));
    EXPECT_EQ(displayed_differences(grey, Image(32, 32, Rgb(0.21f))).yee_failed, 0u);
    EXPECT_EQ(displayed_differences(grey, Image(32, 32, Rgb(0.22f))).yee_failed, 32u * 32u);
    EXPECT_EQ(displayed_differences(Image(8, 8, Rgb(0)), Image(8, 8, Rgb(1))).yee_failed, 64u);
    // Of one luminance (0.2), but another hue.
    EXPECT_EQ(displayed_differences(grey, Image(32, 32, Rgb(0.4f, 0.1407f, 0.2f))).yee_failed, 32u * 32u);
}

TEST(Compare, HeatGrowsLighter) {
    float before = -1;
    for (int i = 0; i <= 20; ++i) {
        const float now = luminance(heat_color(float(i) / 20));
        EXPECT_GT(now, before);
        before = now;
    }
    const Image sheet = difference_image(Image(5, 4, Rgb(1)), Image(5, 4), std::vector<float>(20, 0.0f), 2);
    EXPECT_EQ(sheet.width, 19);
    EXPECT_EQ(sheet.at(0, 0), Rgb(1));
    EXPECT_EQ(sheet.at(18, 3), Rgb(0));
}

class PointFiles : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& text) {
        write_file(path_, text);
        return path_;
    }
    void TearDown() override { std::filesystem::remove(path_); }
    std::filesystem::path path_ = std::filesystem::temp_directory_path() /
                                  (std::string("daylit_points_") +
                                   testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
};

TEST_F(PointFiles, ReadBackExactly) {
    PointRows points;
    points.measured = true;
    points.rows = {{Vec3(0.1f, -2e-30f, 3e7f), Vec3(0, 1, 0), Rgb(1.0f / 3, 0, 65504)},
                   {Vec3(1, 2, 3), Vec3(0, 0, -1), Rgb(4, 5, 6)}};
    const PointRows back = read_point_rows(write(point_rows_text(points)));
    ASSERT_EQ(back.rows.size(), 2u);
    EXPECT_TRUE(back.measured);
    EXPECT_EQ(back.rows[0].position, points.rows[0].position);
    EXPECT_EQ(back.rows[0].value, points.rows[0].value);
    EXPECT_EQ(back.rows[1].normal, points.rows[1].normal);
}

TEST_F(PointFiles, CommentsHeadAndLineEnds) {
    const PointRows points = read_point_rows(write("# from a test\r\nx,y,z,nx,ny,nz\r\n\r\n1, 2,3,0,1,+0\r\n4,5,6,0,0,1"));
    ASSERT_EQ(points.rows.size(), 2u);
    EXPECT_FALSE(points.measured);
    EXPECT_EQ(points.rows[1].position, Vec3(4, 5, 6));
}

TEST_F(PointFiles, BadRowsAreNamed) {
    for (const char* text : {"", "x,y,z,nx,ny,nz\n", "1,2,3\n", "1,2,3,4,5,6,7,8,9,10\n", "1,2,3,0,1,zero\n",
                             "1,2,3,0,1,nan\n", "1,2,3,0,1,0\n1,2,3,0,1,0,1,1,1\n", "x\nx\n", "1,2,3,0,1,1e999\n",
                             "1,2,3,0,1,0,\n"}) {
        EXPECT_THROW(read_point_rows(write(text)), Error) << text;
    }
    EXPECT_TRUE(std::isnan(read_point_rows(write("1,2,3,0,1,0,nan,1,inf\n")).rows[0].value.r));
}

}  // namespace
}  // namespace daylit
