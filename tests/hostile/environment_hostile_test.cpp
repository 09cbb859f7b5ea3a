// Damaged and odd sky images: refused in one line, or made finite.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "engine/base/error.h"
#include "engine/scene/sky.h"

namespace daylit {
namespace {

TEST(HostileSky, DamagedImagesAreRefusedAndOddOnesMadeFinite) {
    const std::filesystem::path folder = DAYLIT_SHARED_DIR "/hostile/hdr-damaged";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "NOT RUN: " << folder << " is missing";
    const std::set<std::string> usable = {"nan-pixel.exr",          "inf-pixel.exr",   "negative-pixels.exr",
                                          "sun-1e30.exr",           "one-channel.exr", "five-channels.exr",
                                          "channels-bgr-names.exr", "one-pixel.exr",   "two-by-one.exr"};
    int seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() == ".csv") continue;
        ++seen;
        LightSettings settings;
        settings.sun = SunSource::None;
        settings.sky = SkySource::File;
        settings.sky_file = entry.path();
        if (!usable.contains(name)) {
            try {
                LightModel model(settings, {});
                ADD_FAILURE() << name << " was taken";
            } catch (const Error& error) {
                const std::string line = error.what();
                EXPECT_NE(line.find(name), std::string::npos) << line;
                EXPECT_EQ(line.find('\n'), std::string::npos) << line;
            }
            continue;
        }
        const Lighting light = LightModel(settings, {}).at(12.0);
        for (const Rgb& pixel : light.sky.map.pixels) {
            for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(pixel[c]) && pixel[c] >= 0.0f) << name;
        }
    }
    EXPECT_GE(seen, 20);
}

TEST(HostileSky, ChannelsByNameAndOneChannelAsGrey) {
    const std::filesystem::path folder = DAYLIT_SHARED_DIR "/hostile/hdr-damaged";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "NOT RUN: " << folder << " is missing";
    LightSettings settings;
    settings.sky = SkySource::File;
    settings.sun = SunSource::None;
    settings.sky_file = folder / "channels-bgr-names.exr";
    EXPECT_EQ(LightModel(settings, {}).at(0.0).sky.map.pixels[0], Rgb(1, 2, 3));
    settings.sky_file = folder / "one-channel.exr";
    const Rgb grey = LightModel(settings, {}).at(0.0).sky.map.pixels[0];
    EXPECT_EQ(grey.r, grey.g);
    EXPECT_EQ(grey.g, grey.b);
    settings.sky_file = folder / "no-such-sky.exr";
    EXPECT_THROW(LightModel(settings, {}), Error);
}

}  // namespace
}  // namespace daylit
