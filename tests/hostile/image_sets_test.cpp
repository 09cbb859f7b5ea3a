// Damaged images give one clear Error, or the pixels that the file holds.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/image.h"
#include "tests/hostile/index_file.h"

namespace daylit {
namespace {

class HostileImages : public testing::TestWithParam<const char*> {};

TEST_P(HostileImages, give_an_error_or_pixels) {
    const std::filesystem::path folder = std::filesystem::path(DAYLIT_SHARED_DIR) / "hostile" / GetParam();
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "NOT RUN: the folder " << folder << " is missing";
    std::size_t refused = 0;
    for (const auto& row : test::read_index(folder / "index.csv")) {
        const std::string file = row.at("file");
        try {
            const Image image = read_image(folder / file);
            EXPECT_EQ(row.at("oiio_2_4_7"), "decodes") << file;
            EXPECT_EQ(image.pixels.size(), std::size_t(image.width) * std::size_t(image.height)) << file;
            EXPECT_FALSE(image.empty()) << file;
        } catch (const Error& error) {
            EXPECT_NE(row.at("oiio_2_4_7"), "decodes") << file << ": " << error.what();
            EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
            for (const unsigned char c : std::string(error.what())) ASSERT_GE(c, ' ') << file;
            ++refused;
        }
    }
    EXPECT_GT(refused, 0u);
}

INSTANTIATE_TEST_SUITE_P(sets, HostileImages, testing::Values("openexr-damaged", "hdr-damaged"), [](const auto& info) {
    return std::string(info.param) == "hdr-damaged" ? "hdr_damaged" : "openexr_damaged";
});

std::filesystem::path odd_image(const char* name) {
    return std::filesystem::path(DAYLIT_SHARED_DIR) / "hostile/hdr-damaged" / name;
}

TEST(HostileImages, odd_values_come_back_as_stored) {
    if (!std::filesystem::exists(odd_image("nan-pixel.exr"))) GTEST_SKIP() << "NOT RUN: ../shared/hostile is missing";
    const auto count = [](const Image& image, bool (*holds)(float)) {
        std::size_t n = 0;
        for (const Rgb& pixel : image.pixels) n += holds(pixel.r);
        return n;
    };
    EXPECT_EQ(count(read_image(odd_image("nan-pixel.exr")), [](float v) { return std::isnan(v); }), 1u);
    EXPECT_EQ(count(read_image(odd_image("inf-pixel.exr")), [](float v) { return std::isinf(v); }), 1u);
    EXPECT_GT(count(read_image(odd_image("negative-pixels.exr")), [](float v) { return v < 0; }), 0u);
    EXPECT_EQ(count(read_image(odd_image("sun-1e30.exr")), [](float v) { return v > 9e29f; }), 1u);
}

TEST(HostileImages, channels_go_by_their_names) {
    if (!std::filesystem::exists(odd_image("channels-bgr-names.exr")))
        GTEST_SKIP() << "NOT RUN: ../shared/hostile is missing";
    EXPECT_EQ(read_image(odd_image("channels-bgr-names.exr")).at(0, 0), Rgb(1, 2, 3));
    const Rgb grey = read_image(odd_image("one-channel.exr")).at(0, 0);
    EXPECT_EQ(grey.r, grey.g);
    EXPECT_EQ(grey.r, grey.b);
}

}  // namespace
}  // namespace daylit
