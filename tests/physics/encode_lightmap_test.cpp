// Tiles of few patterns: as wrong as they say, for every part of light by itself, without seams.
#include "gi/encode/encode_lightmap.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

constexpr int kSide = 40;  // texels: tiles that are whole and tiles that are not
constexpr std::size_t kHours = 30;

/// Light with as many components as columns: the sun's answer moves over the map, the sky's shades from top to bottom,
/// the right half lies in a room a thousand times darker.
struct Given {
    std::vector<Rgb> rows;
    LightRows light;
    std::vector<std::uint32_t> row_of_pixel;
};

Given moving_light() {
    Given given;
    LightBasis& basis = given.light.light;
    for (std::size_t k = 0; k < kHours; ++k) basis.hours.push_back(4.0 + 0.5 * double(k));
    basis.suns = basis.skies = kHours;
    basis.sky_level.assign(kHours, 1.0f);
    basis.components = int(basis.columns());
    basis.curves.assign(basis.columns() * basis.columns(), 0.0f);
    for (std::size_t c = 0; c < basis.columns(); ++c) basis.curves[c * basis.columns() + c] = 1.0f;
    const auto height_at = [](double day) { return std::max(0.0, std::sin(kPi * day)); };
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const double u = double(x) / kSide, v = double(y) / kSide, open = x < kSide / 2 ? 1.0 : 1e-3;
            for (const bool sky : {false, true})
                for (std::size_t k = 0; k < kHours; ++k) {
                    const double day = double(k) / (kHours - 1), off = u - day;
                    const double light =
                        sky ? 20000.0 * height_at(day) * (0.3 + 0.7 * v) + 1e-3 : 0.3 * std::exp(-4.0 * off * off);
                    given.rows.push_back(float(open * light) * (sky ? Rgb(0.8f, 1.0f, 1.3f) : Rgb(1.0f, 0.9f, 0.7f)));
                }
            for (std::size_t s = 0; s < kStillColumns; ++s)
                given.rows.push_back(float(open) * Rgb(float(0.1 + u * double(s)), float(0.2 + v), 0.3f));
            given.row_of_pixel.push_back(std::uint32_t(given.row_of_pixel.size()));
        }
    given.light.rows = given.rows;
    for (std::size_t k = 0; k < kHours; ++k) {
        const double height = height_at(double(k) / (kHours - 1));
        const LightScales clear = {.sun = Rgb(float(90000.0 * height)),
                                   .clear = 1.0f,
                                   .ground = Rgb(float(20000.0 * height)),
                                   .night = 1.0f,
                                   .evening = 1.0f};
        given.light.moments.push_back({basis.hours[k], clear, 10000.0 * height + 1.0});
        if (k % 5 == 0)
            given.light.moments.push_back({basis.hours[k],
                                           {.overcast = Rgb(float(9000.0 * height + 1.0)), .night = 1.0f},
                                           3000.0 * height + 1.0});
    }
    return given;
}

EncodedLightmap encoded(const Given& given, const LightmapSettings& settings = {}) {
    DayLightmap shape;
    shape.width = shape.height = kSide;
    return encode_lightmap(shape, given.light, {}, given.row_of_pixel, settings);
}

Vec2 centre(int x, int y) {
    return (Vec2(x, y) + 0.5f) / float(kSide);
}

Rgb truth(const Given& given, std::size_t row, const LightScales& scales, double hour) {
    const std::vector<Rgb> weights = given.light.light.weights(scales, hour);
    Rgb sum(0.0f);
    for (std::size_t r = 0; r < weights.size(); ++r) sum += given.light.row(row)[r] * weights[r];
    return sum;
}

/// The largest error of a texel's channels, relative to its own light.
/// light   tile_light() at this moment
double error_of_texel(const Given& given, const DayLightmap& map, const std::vector<Rgb>& light,
                      const LightScales& scales, double hour, int x, int y) {
    const Rgb expected = truth(given, std::size_t(y * kSide + x), scales, hour);
    const Rgb off = glm::abs(map.irradiance(centre(x, y), light) - expected);
    return double(std::max({off.x, off.y, off.z}) / luminance(expected));
}

/// The largest of all texels.
double worst_error(const Given& given, const DayLightmap& map, const LightScales& scales, double hour) {
    const std::vector<Rgb> light = map.tile_light(map.basis.weights(scales, hour));
    double worst = 0.0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) worst = std::max(worst, error_of_texel(given, map, light, scales, hour, x, y));
    return worst;
}

TEST(EncodeLightmap, TexelsAreRightAtEveryMoment) {
    const Given given = moving_light();
    const EncodedLightmap result = encoded(given);
    EXPECT_LT(result.error, 0.015);
    EXPECT_LE(result.map.slots(), DayLightmap::kMostPatterns);
    EXPECT_LT(result.map.basis.hours.size(), kHours);
    // In sunlit rooms and dark ones alike; so no seam between tiles is larger than twice this.
    for (const Moment& m : given.light.moments) {
        if (m.scales.sun.x <= 5000.0f && m.scales.overcast.x <= 500.0f) continue;
        EXPECT_LT(worst_error(given, result.map, m.scales, m.hour), 0.06) << m.hour;
    }
}

TEST(EncodeLightmap, WeatherAndTintNeedNoNewBake) {
    const Given given = moving_light();
    const DayLightmap map = encoded(given).map;
    const LightScales red_sun = {
        .sun = Rgb(60000, 20000, 5000), .clear = 0.4f, .overcast = Rgb(4000.0f), .evening = 0.5f};
    EXPECT_LT(worst_error(given, map, red_sun, 11.0), 0.06);
    EXPECT_LT(worst_error(given, map, {.clear = 1.0f, .evening = 0.0f}, 11.0), 0.06);
}

TEST(EncodeLightmap, WhatItSaysIsWhatIsMeasured) {
    const Given given = moving_light();
    LightmapSettings coarse;
    coarse.most_patterns = 2, coarse.error = 0.0;
    const EncodedLightmap few = encoded(given, coarse), many = encoded(given);
    EXPECT_EQ(few.map.slots(), 2);
    EXPECT_GT(few.error, 2.0 * many.error);
    EXPECT_GE(few.worst_tile, few.error);
}

TEST(EncodeLightmap, LightThatOnlyDimsTakesOnePattern) {
    Given given = moving_light();
    const std::size_t stride = given.light.stride();
    for (std::size_t i = stride; i < given.rows.size(); ++i)
        given.rows[i] = given.rows[i % stride] * (1.0f + float(i / stride % 7));
    given.light.rows = given.rows;
    EXPECT_EQ(encoded(given).map.slots(), 1);
}

TEST(EncodeLightmap, GapsAndBlackTilesTakeNoPatterns) {
    Given given = moving_light();
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < DayLightmap::kTileSide; ++x) given.row_of_pixel[std::size_t(y * kSide + x)] = ~0u;
    const DayLightmap map = encoded(given).map;
    EXPECT_EQ(map.tile_patterns[0], 0);
    EXPECT_GT(map.tile_patterns[1], 0);
    std::fill(given.rows.begin(), given.rows.end(), Rgb(0.0f));
    given.light.rows = given.rows;
    EXPECT_EQ(encoded(given).map.slots(), 0);
}

/// Beside candles: a few texels are hundreds of times as bright in the evening as they are by day.
TEST(EncodeLightmap, TexelsBesideAnEveningLampAreRightByDayToo) {
    Given given = moving_light();
    const std::size_t stride = given.light.stride(), evening = stride - kStillColumns + std::size_t(StillPart::Evening);
    std::vector<glm::ivec2> beside;
    for (int i = 0; i < 5; ++i) {
        beside.emplace_back(3 + 2 * i, 8 + i % 2);
        given.rows[std::size_t(beside[std::size_t(i)].y * kSide + beside[std::size_t(i)].x) * stride + evening] =
            1e7f * Rgb(1.0f, 0.6f, 0.3f);
    }
    given.light.rows = given.rows;
    for (Moment& m : given.light.moments) {
        m.scales.evening = m.exposure > 500.0 ? 0.0f : 1.0f;
        if (m.scales.evening > 0.0f) m.exposure = 20000.0;  // the lamps', on average
    }
    const DayLightmap map = encoded(given).map;
    for (const Moment& m : given.light.moments) {
        if (m.scales.evening == 0.0f && m.scales.sun.x <= 5000.0f) continue;
        const std::vector<Rgb> light = map.tile_light(map.basis.weights(m.scales, m.hour));
        for (const glm::ivec2& t : beside)
            EXPECT_LT(error_of_texel(given, map, light, m.scales, m.hour, t.x, t.y), 0.04) << m.hour;
    }
}

/// Tilts that follow other hours than the light itself, on the left half of the map.
TEST(EncodeLightmap, TiltsAreAsRightAsTexels) {
    const Given given = moving_light();
    const std::size_t stride = given.light.stride();
    std::vector<std::uint32_t> of_row;
    std::vector<Rgb> rows;
    for (std::size_t row = 0; row < given.row_of_pixel.size(); ++row) {
        const bool tilted = row % kSide < kSide / 2;
        of_row.push_back(tilted ? std::uint32_t(rows.size() / (2 * stride)) : ~0u);
        for (std::size_t axis = 0; tilted && axis < 2; ++axis)
            for (std::size_t i = 0; i < stride; ++i)
                rows.push_back((axis ? -0.4f : 0.5f * float(i) / float(stride)) * given.rows[row * stride + i]);
    }
    DayLightmap shape;
    shape.width = shape.height = kSide;
    const DayLightmap map = encode_lightmap(shape, given.light, {of_row, rows}, given.row_of_pixel, {}).map;
    EXPECT_EQ(map.tile_tilted, (std::vector<std::uint8_t>{1, 1, 0, 1, 1, 0, 1, 1, 0}));

    for (const Moment& m : given.light.moments) {
        if (m.scales.sun.x <= 5000.0f) continue;
        const std::vector<Rgb> weights = given.light.light.weights(m.scales, m.hour),
                               light = map.tile_light(map.basis.weights(m.scales, m.hour));
        for (std::size_t row = 0; row < given.row_of_pixel.size(); row += 7) {
            Rgb is(0.0f);
            std::array<Rgb, 2> tilt{Rgb(0.0f), Rgb(0.0f)};
            for (std::size_t r = 0; r < stride; ++r) {
                is += given.rows[row * stride + r] * weights[r];
                for (std::size_t axis = 0; of_row[row] != ~0u && axis < 2; ++axis)
                    tilt[axis] += rows[(2 * of_row[row] + axis) * stride + r] * weights[r];
            }
            const Vec2 uv = centre(int(row % kSide), int(row / kSide));
            for (const Vec3& lean : {Vec3(0.3f, 0.0f, 0.95f), Vec3(0.0f, -0.3f, 0.95f)}) {
                const Rgb expected = is * (0.5f + 0.5f * lean.z) + lean.x * tilt[0] + lean.y * tilt[1];
                EXPECT_LT(glm::distance(map.irradiance(uv, lean, light), expected), 0.06f * luminance(is)) << m.hour;
            }
        }
    }
}

TEST(EncodeLightmap, SameTexelsForAnyNumberOfThreads) {
    const Given given = moving_light();
    DayLightmap one, five;
    tbb::task_arena(1).execute([&] { one = encoded(given).map; });
    tbb::task_arena(5).execute([&] { five = encoded(given).map; });
    EXPECT_EQ(one.values, five.values);
    EXPECT_EQ(one.patterns, five.patterns);
    EXPECT_EQ(one.scales, five.scales);
    EXPECT_EQ(one.basis.curves, five.basis.curves);
}

}  // namespace
}  // namespace daylit
