// Filtering over neighbours: noise goes, what light does along the surface stays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/random.h"
#include "gi/surface/smooth.h"
#include "gi/transport/day_gather/texel_tilts.h"
#include "tests/physics/scenes.h"

namespace daylit {
namespace {

/// Two floors of 4 m side by side, of which the second is painted otherwise and ends in a slope.
TestScene floors() {
    TestScene made;
    for (const float x : {0.0f, 4.0f})
        made.quad(made.add(lambert(Rgb(0.5f))), Vec3(x, 0, 0), Vec3(0, 0, 4), Vec3(4, 0, 0));
    made.triangle(0, Vec3(8, 0, 0), Vec3(8, 0, 4), Vec3(9, 1, 0));
    return made;
}

struct Smoothed {
    Smoothed()
        : made(floors()),
          rays(made.scene, made.mesh),
          atlas(make_atlas(made.mesh, 1200)),
          texels(make_texels(made.mesh, atlas)),
          nearness(texels.count(), 100.0f),
          weights(smoothing_weights(rays, texels, nearness, std::vector<bool>(texels.count(), true))) {}

    TestScene made;
    RayScene rays;
    Atlas atlas;
    Texels texels;
    std::vector<float> nearness;
    SmoothingWeights weights;
};

TEST(Smooth, LightThatChangesEvenlyStaysAsItIsUpToTheRims) {
    const Smoothed s;
    const Rgb slope(0.3f, -0.2f, 0.1f);
    std::vector<Rgb> rows;
    for (const Vec3& p : s.texels.position) rows.push_back(Rgb(5.0f) + p.x * slope + p.z * slope.y);
    const std::vector<Rgb> before = rows;
    smooth(s.weights, 1, rows);
    float worst = 0.0f;
    for (std::size_t t = 0; t < rows.size(); ++t)
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(rows[t][c] - before[t][c]));
    const float texel = *std::max_element(s.texels.width.begin(), s.texels.width.end());
    EXPECT_LT(worst, 0.03f * glm::length(slope) * texel);  // a mean is wrong by more than a texel's share
}

// Where what is seen is five texels away on average, light may bend within as many.
TEST(Smooth, LightThatBendsNearItsSurroundingsStaysNearlyAsItIs) {
    Smoothed s;
    const float width = s.texels.width[0];
    s.nearness.assign(s.texels.count(), 5.0f * width);
    s.weights = smoothing_weights(s.rays, s.texels, s.nearness, std::vector<bool>(s.texels.count(), true));
    std::vector<Rgb> rows;
    for (const Vec3& p : s.texels.position) rows.push_back(Rgb((p.x - 2.0f) * (p.x - 2.0f)));
    const std::vector<Rgb> before = rows;
    smooth(s.weights, 1, rows);
    for (std::size_t t = 0; t < rows.size(); ++t) {
        const Vec3& p = s.texels.position[t];
        if (std::max(std::abs(p.x - 2.0f), std::abs(p.z - 2.0f)) > 1.0f) continue;
        EXPECT_LT(std::abs(rows[t].x - before[t].x), 1.3f * width * width);
    }
}

TEST(Smooth, NoiseFallsAtRimsToo) {
    const Smoothed s;
    Random random(3, 0, 0);
    std::vector<Rgb> rows;
    for (std::size_t t = 0; t < s.texels.count(); ++t) rows.push_back(Rgb(random.next() < 0.5f ? 0.0f : 2.0f));
    smooth(s.weights, 1, rows);
    double rim = 0.0, rims = 0.0, inner = 0.0, inners = 0.0;
    for (std::size_t t = 0; t < rows.size(); ++t) {
        const Vec3& p = s.texels.position[t];
        if (p.x > 7.0f) continue;
        const double square = double((rows[t].x - 1.0f) * (rows[t].x - 1.0f));
        const float width = s.texels.width[t];
        if (std::min({p.x, p.z, 4.0f - p.z}) < width) rim += square, ++rims;
        if (std::min({p.x, p.z, 4.0f - p.z}) > 4.0f * width) inner += square, ++inners;
    }
    ASSERT_GT(std::min(rims, inners), 50.0);
    EXPECT_LT(std::sqrt(rim / rims), 0.55);  // of 1
    EXPECT_LT(std::sqrt(inner / inners), 0.25);
}

// A neighbour with a weight below 0 and one without tilts: what is left of the weights sums to a tenth.
TEST(Smooth, TiltsDoNotGrowBesideTexelsWithout) {
    const Smoothed s;
    const GatherScene scene = gather_scene(s.rays, s.atlas, s.texels, {});
    SmoothingWeights weights;
    weights.first.assign(s.texels.count() + 1, 3);
    weights.first[0] = 0;
    weights.texel = {0, 1, 2}, weights.weight = {0.4f, -0.3f, 0.9f};
    TexelTilts tilts;
    tilts.row_of_texel.assign(s.texels.count(), ~0u);
    tilts.row_of_texel[0] = 0, tilts.row_of_texel[1] = 1;
    tilts.texel_of_row = {0, 1};
    tilts.rows = {Rgb(1.0f), Rgb(0.0f), Rgb(0.0f), Rgb(0.0f)};  // along u and v each
    smooth_tilts(scene, weights, 1, tilts);
    EXPECT_NEAR(tilts.rows[0].x, 1.3f, 1e-5f);
    EXPECT_NEAR(tilts.rows[1].x, 0.0f, 1e-5f);
}

}  // namespace
}  // namespace daylit
