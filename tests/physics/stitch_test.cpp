// Small round things, a texel a chart: their light goes on smoothly from chart to chart, and is what it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gi/surface/charts.h"
#include "volume_scenes.h"

namespace daylit {
namespace {

constexpr int kSides = 20;
constexpr float kRadius = 0.1f, kHeight = 0.2f;
const Rgb kSky(1000.0f);

Vec3 outwards(float turn) {
    const double angle = 2.0 * kPi * double(turn) / kSides;
    return {float(std::cos(angle)), 0.0f, -float(std::sin(angle))};
}

/// A smoothly shaded drum beside a black wall, which takes half of the sky from one side of it and little from the
/// other. The first triangles are the drum's, two a side.
TestScene drum() {
    TestScene made;
    const std::uint32_t grey = made.add(lambert(Rgb(0.5f)));
    for (int k = 0; k < kSides; ++k) {
        const Vec3 from = kRadius * outwards(float(k)), to = kRadius * outwards(float((k + 1) % kSides)),
                   up(0, kHeight, 0);
        made.triangle(grey, from, to, to + up);  // sides share corners to the last bit
        made.triangle(grey, from, to + up, from + up);
    }
    for (std::size_t i = 0; i < made.mesh.normals.size(); ++i)
        made.mesh.normals[i] = glm::normalize(made.mesh.positions[i] * Vec3(1, 0, 1));
    made.box(made.add(lambert(Rgb(0.0f))), Vec3(-0.6f, -2, -2), Vec3(-0.5f, 2, 2));
    return made;
}

class LitDrum {
  public:
    LitDrum() : made_(drum()), scene_(with_plates(made_, {})) {
        BakeSettings settings = one_hour();
        settings.light.sky = SkySource::Constant, settings.light.sky_radiance = kSky;
        settings.parts = {"lightmap"};
        settings.tuning.texels = 0.01;  // texels wider than the drum
        baked_ = bake(scene_, settings);
        const LightScales scales = LightModel(baked_.light, {}).scales(12.0, 0.0);
        light_ = baked_.lightmap->tile_light(baked_.lightmap->basis.weights(scales, 12.0));
    }
    /// Half way up a side. share: of the way along it
    double at(int side, float share) const {
        const Vec2* uv = baked_.lightmap->corner_uvs.data() + 6 * side;  // left below, right below, right above
        const Vec2 up = 0.5f * (uv[2] - uv[1]);
        return double(luminance(baked_.lightmap->irradiance(uv[0] + share * (uv[1] - uv[0]) + up, light_)));
    }
    double traced(int side) {
        const float turn = float(side) + 0.5f;
        const Vec3 place =
            (1.001f * kRadius * std::cos(float(kPi) / kSides)) * outwards(turn) + Vec3(0, 0.5f * kHeight, 0);
        return double(luminance(irradiance_at(made_.trace(), constant_sky(kSky), place, outwards(turn), 4096)));
    }

  private:
    TestScene made_;
    Scene scene_;
    Baked baked_;
    std::vector<Rgb> light_;
};

TEST(Stitch, SidesOfADrumAgreeWhereTheyMeet) {
    const LitDrum lit;
    double least = INFINITY, most = 0.0;
    for (int side = 0; side < kSides; ++side) {
        const double here = lit.at(side, 1.0f), there = lit.at((side + 1) % kSides, 0.0f);
        EXPECT_LT(std::abs(here - there), 0.03 * (here + there)) << side;
        least = std::min(least, here), most = std::max(most, here);
    }
    EXPECT_GT(most, 2.0 * least);
}

TEST(Stitch, ADrumIsAsBrightAsItIs) {
    LitDrum lit;
    double square = 0.0, all = 0.0;
    for (int side = 0; side < kSides; ++side) {
        const double truth = lit.traced(side), wrong = lit.at(side, 0.5f) - truth;
        square += wrong * wrong, all += truth * truth;
    }
    EXPECT_LT(std::sqrt(square / all), 0.12);
}

TEST(Stitch, PiecesEndAtCreases) {
    TestScene made = drum();
    made.quad(0, kRadius * outwards(0), Vec3(0, 0, 1), Vec3(1, 0, 0));
    const std::vector<std::uint32_t> piece = smooth_pieces(made.mesh);
    for (int t = 0; t < 2 * kSides; ++t) EXPECT_EQ(piece[std::size_t(t)], piece[0]);
    EXPECT_NE(piece.back(), piece[0]);
    EXPECT_NE(piece[2 * kSides], piece[2 * kSides + 2]);  // sides of the wall
    EXPECT_EQ(piece[2 * kSides], piece[2 * kSides + 1]);
}

}  // namespace
}  // namespace daylit
