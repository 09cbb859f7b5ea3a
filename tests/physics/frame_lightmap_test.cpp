// A moment of an uncompressed day, drawn as it is.
#include "gi/encode/frame_lightmap.h"

#include <gtest/gtest.h>

#include "engine/base/random.h"

namespace daylit {
namespace {

TEST(FrameLightmap, HoldsTheMomentsLightAndTiltsAtAnyHour) {
    constexpr int kSide = 20, kComponents = 5;
    Random random(3, 0, 0);
    const auto any = [&](float from, float to) { return from + (to - from) * random.next(); };
    const auto any_colour = [&](float from, float to) { return Rgb(any(from, to), any(from, to), any(from, to)); };
    std::vector<Rgb> light, tilts, weights;
    std::vector<std::uint32_t> tilt_of_row, row_of_pixel;
    for (int r = 0; r < kComponents; ++r) weights.push_back(any_colour(0.5f, 2.0f));
    for (std::uint32_t row = 0; row < kSide * kSide; ++row) {
        row_of_pixel.push_back(row % 7 == 0 ? ~0u : row);
        tilt_of_row.push_back(row % 2 ? std::uint32_t(tilts.size() / (2 * kComponents)) : ~0u);
        const bool cellar = row % kSide >= DayLightmap::kTileSide;
        const float bright = (cellar ? 1e-6f : 1.0f) * std::exp2(any(0.0f, 12.0f));  // rooms and the open air
        for (int r = 0; r < kComponents; ++r) light.push_back(bright * any_colour(0.5f, 1.0f));
        for (int r = 0; r < 2 * kComponents && row % 2; ++r) tilts.push_back(bright * any_colour(-0.2f, 0.2f));
    }
    LightRows rows;
    rows.light.components = kComponents;
    rows.rows = light;
    DayLightmap shape;
    shape.width = shape.height = kSide;
    const DayLightmap map = frame_lightmap(shape, rows, {tilt_of_row, tilts}, row_of_pixel, weights);

    const std::vector<Rgb> shown = map.tile_light(map.basis.weights({.night = 1.0f}, 17.3));
    const Vec3 lean(0.36f, -0.48f, 0.8f);
    for (std::uint32_t row = 0; row < kSide * kSide; ++row) {
        const Vec2 centre = (Vec2(row % kSide, row / kSide) + 0.5f) / float(kSide);
        std::array<Rgb, 3> sum{};  // irradiance and its tilts
        for (int r = 0; r < kComponents && row_of_pixel[row] != ~0u; ++r) {
            sum[0] += weights[std::size_t(r)] * light[row * kComponents + std::uint32_t(r)];
            for (std::uint32_t axis = 0; axis < 2 && tilt_of_row[row] != ~0u; ++axis)
                sum[1 + axis] +=
                    weights[std::size_t(r)] * tilts[(2 * tilt_of_row[row] + axis) * kComponents + std::uint32_t(r)];
        }
        const Rgb leaned = 0.9f * sum[0] + lean.x * sum[1] + lean.y * sum[2];
        EXPECT_LE(glm::distance(map.irradiance(centre, shown), sum[0]), 0.003f * luminance(sum[0])) << row;
        EXPECT_LE(glm::distance(map.irradiance(centre, lean, shown), leaned), 0.01f * luminance(sum[0])) << row;
    }
}

}  // namespace
}  // namespace daylit
