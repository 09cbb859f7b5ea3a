// Contact sheets and films of a day.
#include "demo/contact_sheet.h"

#include <gtest/gtest.h>

#include <fstream>

#include "demo/movie.h"
#include "engine/base/error.h"

namespace daylit {
namespace {

TEST(ContactSheet, ShrinkAveragesBlocks) {
    Image image(5, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 5; ++x) image.at(x, y) = Rgb(float(x));
    }
    const Image small = shrink(image, 2);
    EXPECT_EQ(small.width, 2);
    EXPECT_EQ(small.height, 2);
    EXPECT_EQ(small.at(0, 1), Rgb(0.5f));
    EXPECT_EQ(small.at(1, 0), Rgb(2.5f));
    EXPECT_EQ(shrink(Image(1, 1, Rgb(7)), 3).at(0, 0), Rgb(7));
}

TEST(ContactSheet, TilesKeepTheirOrderAndStayApart) {
    ContactSheet sheet(6, 160, 90);
    const std::vector<Rgb> colors = {Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb(1, 1, 0), Rgb(0, 1, 1), Rgb(1, 0, 1)};
    for (const Rgb& color : colors) sheet.add(Image(160, 90, color), "12:00");
    std::vector<int> pixels(colors.size());
    std::vector<int> first(colors.size(), -1);
    const Image& image = sheet.image();
    for (int i = 0; i < int(image.pixels.size()); ++i) {
        for (std::size_t c = 0; c < colors.size(); ++c) {
            if (image.pixels[std::size_t(i)] != colors[c]) continue;
            ++pixels[c];
            if (first[c] < 0) first[c] = i;
        }
    }
    for (std::size_t c = 0; c < colors.size(); ++c) {
        EXPECT_EQ(pixels[c], 160 * 90);
        if (c > 0) {
            EXPECT_GT(first[c], first[c - 1]);
        }
    }
}

TEST(ContactSheet, LargePicturesAreShrunkToFit) {
    const ContactSheet sheet(24, 1280, 720);
    EXPECT_LE(sheet.image().width, 2400);
    EXPECT_GE(sheet.image().width, 1200);
    EXPECT_GT(sheet.image().height, 600);
    EXPECT_LT(sheet.image().height, 2400);
}

TEST(ContactSheet, TextDrawsItsDots) {
    Image image(40, 10);
    draw_text(image, 1, 1, "1:", 1, Rgb(1));
    int dots = 0;
    for (const Rgb& pixel : image.pixels) dots += pixel == Rgb(1);
    EXPECT_EQ(dots, 10 + 4);  // a one: two in its second row, three in its foot, one in each of the other five
    EXPECT_EQ(text_width("12:00", 2), (5 * 6 - 1) * 2);
    draw_text(image, 38, 8, "888", 3, Rgb(1));  // runs over the edge
}

TEST(Movie, FramesBecomeAFile) {
    const std::filesystem::path ffmpeg = find_ffmpeg();  // demo/setup --tests installs it
    const std::filesystem::path output = std::filesystem::temp_directory_path() / "-daylit film: it's a test.mp4";
    {
        Movie movie(ffmpeg, output, 33, 17, 24.0);  // odd sides
        for (int i = 0; i < 5; ++i) movie.add(Image(33, 17, Rgb(0.2f * float(i))));
        movie.finish();
    }
    std::ifstream file(output, std::ios::binary);
    std::string head(12, ' ');
    file.read(head.data(), 12);
    EXPECT_EQ(head.substr(4, 4), "ftyp");
    file.close();
    std::filesystem::remove(output);
}

TEST(Movie, AFailingEncoderIsOneError) {
    const std::filesystem::path output = std::filesystem::temp_directory_path() / "daylit_never.mp4";
    Movie movie("/bin/false", output, 64, 64, 24.0);
    EXPECT_THROW(
        {
            for (int i = 0; i < 1000; ++i) movie.add(Image(64, 64));
            movie.finish();
        },
        Error);
    EXPECT_THROW(Movie("/no/such/ffmpeg", output, 64, 64, 24.0), Error);
}

}  // namespace
}  // namespace daylit
