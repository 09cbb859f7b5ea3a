#include "engine/base/image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/png_check.h"
#include "tests/support/gltf_builder.h"

namespace daylit {
namespace {

/// Every pixel different; red may leave [0,1].
Image gradient(int width, int height, float red) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = Rgb(red * float(x), float(y) / float(height), 0.25f);
    return image;
}

TEST(Image, exr_keeps_every_bit) {
    const test::TemporaryFolder folder;
    Image image = gradient(7, 5, 1000.0f);
    image.at(3, 2) = Rgb(-1.0f, 1e30f, 1e-30f);
    write_image(folder / "a.exr", image, "made by a test");
    const Image back = read_image(folder / "a.exr");
    ASSERT_EQ(back.width, 7);
    ASSERT_EQ(back.height, 5);
    EXPECT_EQ(back.pixels, image.pixels);
}

TEST(Image, exr_keeps_nan) {
    const test::TemporaryFolder folder;
    Image image = gradient(4, 4, 1.0f);
    image.at(1, 1).g = std::nanf("");
    write_image(folder / "a.exr", image);
    EXPECT_TRUE(std::isnan(read_image(folder / "a.exr").at(1, 1).g));
}

TEST(Image, png_is_srgb_to_half_a_step) {
    const test::TemporaryFolder folder;
    const Image image = gradient(16, 9, 1.0f / 15.0f);
    write_image(folder / "a.png", image);
    const Image back = read_image(folder / "a.png");
    ASSERT_EQ(back.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < back.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(encode_srgb(back.pixels[i][c]), encode_srgb(image.pixels[i][c]), 0.5f / 255.0f + 1e-5f);
}

TEST(Image, the_same_picture_has_the_same_bytes) {
    const test::TemporaryFolder folder;
    for (const char* name : {"a.png", "a.exr"}) {
        write_image(folder / name, gradient(33, 17, 0.1f), "comment");
        const auto first = read_file(folder / name);
        write_image(folder / name, gradient(33, 17, 0.1f), "comment");
        EXPECT_EQ(read_file(folder / name), first) << name;
    }
}

TEST(Image, a_texture_from_memory_equals_that_from_its_file) {
    const test::TemporaryFolder folder;
    write_image(folder / "a.png", gradient(5, 3, 0.2f));
    const Image8 from_file = read_image8(folder / "a.png");
    const auto bytes = read_file(folder / "a.png");
    EXPECT_EQ(read_image8(bytes, "memory").rgba, from_file.rgba);
    EXPECT_EQ(from_file.rgba.size(), 60u);
    EXPECT_EQ(from_file.rgba[3], 255);
    EXPECT_EQ(declared_image_size(bytes, "memory"), (std::array<int, 2>{5, 3}));
}

TEST(Image, a_png_changed_in_any_byte_is_found_out) {
    const test::TemporaryFolder folder;
    write_image(folder / "a.png", gradient(5, 3, 0.2f));
    const auto whole = read_file(folder / "a.png");
    EXPECT_EQ(png_damage(whole), "");
    for (std::size_t i = 8; i < whole.size(); ++i) {
        auto changed = whole;
        changed[i] ^= 0x10;
        EXPECT_NE(png_damage(changed), "") << i;
        EXPECT_NE(png_damage(std::span(whole).first(i)), "") << i;
    }
}

TEST(Image, names_and_places_that_cannot_be) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_image(folder / "a.gif", gradient(2, 2, 1)), Error);
    EXPECT_THROW(write_image(folder / "none" / "a.png", gradient(2, 2, 1)), Error);
    EXPECT_THROW(write_image(folder / "a.png", Image()), Error);
    EXPECT_THROW(read_image(folder / "absent.png"), Error);
}

TEST(Srgb, coding_and_decoding_are_inverse_and_hit_known_values) {
    for (int i = 0; i <= 1000; ++i) {
        const float x = float(i) / 1000.0f;
        EXPECT_NEAR(decode_srgb(encode_srgb(x)), x, 2e-6f);
    }
    EXPECT_NEAR(encode_srgb(0.5f), 0.735357f, 1e-5f);  // IEC 61966-2-1
    EXPECT_NEAR(decode_srgb(0.5f), 0.214041f, 1e-5f);
    EXPECT_EQ(encode_srgb(-1.0f), 0.0f);
    EXPECT_EQ(encode_srgb(7.0f), 1.0f);
    EXPECT_EQ(encode_srgb(std::nanf("")), 0.0f);
}

}  // namespace
}  // namespace daylit
