// Surfaces behind what hangs or lies on them: hidden there, and no darker beside it than they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "gi/surface/parting.h"
#include "volume_scenes.h"

namespace daylit {
namespace {

constexpr float kGap = 0.03f, kThick = 0.01f;  // behind a panel, and of it, metres
const Vec2 kPanel(1.0f, 0.8f);
constexpr int kPlaces = 16;  // where panels hang: their rims lie at many places in a texel of 14 cm
const Rgb kSky(1000.0f);

/// A bright wall of 4 x 3 m in the open that looks along z, and a dark panel in front of it.
/// panel   its lower left corner
TestScene wall(std::optional<Vec2> panel, float gap = kGap) {
    TestScene made;
    made.quad(made.add(lambert(Rgb(0.7f))), Vec3(0.0f), Vec3(4, 0, 0), Vec3(0, 3, 0));
    if (panel) made.box(made.add(lambert(Rgb(0.02f))), Vec3(*panel, gap), Vec3(*panel + kPanel, gap + kThick));
    return made;
}

/// A floor of 4 m and the top of a table over its middle, 0.8 m above.
TestScene table() {
    TestScene made;
    made.quad(made.add(lambert(Rgb(0.7f))), Vec3(0.0f), Vec3(0, 0, 4), Vec3(4, 0, 0));
    made.box(made.add(lambert(Rgb(0.02f))), Vec3(0.9f, 0.8f, 0.9f), Vec3(3.1f, 0.85f, 3.1f));
    return made;
}

/// The lightmap of a scene under an even sky, looked up on the parallelogram that its first two triangles are.
class LitPlate {
  public:
    explicit LitPlate(const TestScene& made) : scene_(with_plates(made, {})), mesh_(made.mesh) {
        BakeSettings settings = one_hour();
        settings.light.sky = SkySource::Constant, settings.light.sky_radiance = kSky;
        settings.parts = {"lightmap"};
        settings.tuning.texels = 0.035;  // texels of 14 cm
        baked_ = bake(scene_, settings);
        const LightScales scales = LightModel(baked_.light, {}).scales(12.0, 0.0);
        light_ = baked_.lightmap->tile_light(baked_.lightmap->basis.weights(scales, 12.0));
    }
    double at(const Vec3& place) const {
        const Vec3 a = mesh_.positions[0], u = mesh_.positions[1] - a, diagonal = mesh_.positions[2] - a;
        const Vec3 v = diagonal - u;
        const float s = glm::dot(place - a, u) / glm::dot(u, u), t = glm::dot(place - a, v) / glm::dot(v, v);
        const Vec2* uv = baked_.lightmap->corner_uvs.data() + (t > s ? 3 : 0);
        const Vec2 found = t > s ? uv[0] + s * (uv[1] - uv[2]) + t * (uv[2] - uv[0])
                                 : uv[0] + s * (uv[1] - uv[0]) + t * (uv[2] - uv[1]);
        return double(luminance(baked_.lightmap->irradiance(found, light_)));
    }

  private:
    Scene scene_;
    WorldMesh mesh_;
    Baked baked_;
    std::vector<Rgb> light_;
};

/// Its lower left corner.
Vec2 place_of_panel(int i) {
    return Vec2(1.503f, 1.001f) + 0.0091f * float(i);
}

double traced(TestScene& made, const Vec3& place, const Vec3& normal) {
    return double(luminance(irradiance_at(made.trace(), constant_sky(kSky), place, normal, 4096)));
}

/// Places on the wall this far outside of the middle of a panel's sides.
std::array<Vec3, 4> beside(const Vec2& panel, float away) {
    const Vec2 middle = panel + 0.5f * kPanel, out = 0.5f * kPanel + away;
    return {Vec3(middle.x - out.x, middle.y, 0), Vec3(middle.x + out.x, middle.y, 0),
            Vec3(middle.x, middle.y - out.y, 0), Vec3(middle.x, middle.y + out.y, 0)};
}

/// Light on the wall a few centimetres beside panels, over the true light there: the least and the most.
std::pair<double, double> light_over_truth(float gap) {
    constexpr std::array<float, 3> kAway = {0.02f, 0.04f, 0.08f};
    double least = INFINITY, most = 0.0;
    std::array<std::array<double, 4>, kAway.size()> truth;  // the same wherever the panel hangs
    for (int i = 0; i < kPlaces; ++i) {
        const Vec2 panel = place_of_panel(i);
        TestScene made = wall(panel, gap);
        const LitPlate lit(made);
        for (std::size_t k = 0; k < kAway.size(); ++k)
            for (std::size_t side = 0; side < 4; ++side) {
                const Vec3 place = beside(panel, kAway[k])[side];
                if (i == 0) truth[k][side] = traced(made, place, Vec3(0, 0, 1));
                const double ratio = lit.at(place) / truth[k][side];
                least = std::min(least, ratio), most = std::max(most, ratio);
            }
    }
    return {least, most};
}

TEST(Covered, TheWallBesideAHangingPanelIsAsBrightAsItIs) {
    const auto [least, most] = light_over_truth(kGap);
    EXPECT_GT(least, 0.87);
    EXPECT_LT(most, 1.4);
}

// There a texel may have no more of the wall than a strip of millimetres along the panel, which is darker than the
// rest.
TEST(Covered, TheWallBesideAPanelThatLiesOnItIsAsBrightAsItIs) {
    const auto [least, most] = light_over_truth(0.0f);
    EXPECT_GT(least, 0.75);
    EXPECT_LT(most, 1.1);
}

// Behind a bar much narrower than a texel more than half of the light arrives, and it can be looked at.
TEST(Covered, TheWallBehindAThinBarIsDarkerThanBesideIt) {
    constexpr float kBar = 0.03f;
    double sum = 0.0;
    for (int i = 0; i < kPlaces; ++i) {
        const float left = place_of_panel(i).x;
        TestScene made = wall(std::nullopt);
        made.box(made.add(lambert(Rgb(0.02f))), Vec3(left, 0, kGap), Vec3(left + kBar, 3, kGap + kThick));
        const Vec3 place(left + 0.5f * kBar, 1.5f, 0);
        sum += LitPlate(made).at(place) / traced(made, place, Vec3(0, 0, 1)) / kPlaces;
    }
    EXPECT_GT(sum, 1.0);
    EXPECT_LT(sum, 1.34);
}

TEST(Covered, UnderATableItIsAsDarkAsItIs) {
    TestScene made = table();
    const LitPlate lit(made);
    for (const float x : {1.0f, 1.2f, 1.5f, 2.0f, 2.5f, 3.0f}) {
        const Vec3 place(x, 0, 2);
        EXPECT_NEAR(lit.at(place) / traced(made, place, Vec3(0, 1, 0)), 1.0, 0.15) << x;
    }
}

/// Texels of the parallelogram that a scene's first two triangles are.
struct FirstSurface {
    explicit FirstSurface(TestScene& made)
        : atlas(make_atlas(made.mesh, 850)), texels(make_parted_texels(made.trace(), atlas)) {
        for (std::uint32_t t = 0; t < texels.count(); ++t)
            if (texels.chart[t] == atlas.chart_of_triangle[0]) which.push_back(t);
    }
    Atlas atlas;
    Texels texels;
    std::vector<std::uint32_t> which;
};

TEST(Covered, OnlyTexelsBehindThePanelAre) {
    for (int i = 0; i < kPlaces; ++i) {
        const Vec2 panel = place_of_panel(i);
        TestScene made = wall(panel);
        const FirstSurface wall(made);
        int covered = 0;
        for (const std::uint32_t t : wall.which) {
            const Vec2 p = wall.texels.position[t];
            const bool behind = p.x > panel.x && p.y > panel.y && p.x < panel.x + kPanel.x && p.y < panel.y + kPanel.y;
            covered += behind;
            EXPECT_EQ(wall.texels.covered[t] != 0, behind) << p.x << " " << p.y;
        }
        EXPECT_GT(covered, 30);
    }
}

TEST(Covered, NothingUnderATableIs) {
    TestScene made = table();
    const FirstSurface floor(made);
    EXPECT_GT(floor.which.size(), 100u);
    for (const std::uint32_t t : floor.which) EXPECT_EQ(floor.texels.covered[t], 0) << t;
}

TEST(Covered, ARoundThingDoesNotCoverItself) {
    TestScene made = table();
    const int white = made.add(lambert(Rgb(0.7f)));
    constexpr int kSides = 12;  // a drum over the table, some of its texels as wide as a sixth of it
    const auto rim = [](int k, float height) {
        const double angle = 2.0 * kPi * k / kSides;
        return Vec3(2.0f + 0.1f * float(std::cos(angle)), height, 2.0f - 0.1f * float(std::sin(angle)));
    };
    for (int k = 0; k < kSides; ++k) made.quad(white, rim(k, 1.5f), rim(k + 1, 1.5f) - rim(k, 1.5f), Vec3(0, 0.25f, 0));
    for (std::size_t i = made.mesh.normals.size() - 6 * kSides; i < made.mesh.normals.size(); ++i)  // shaded smoothly
        made.mesh.normals[i] = glm::normalize((made.mesh.positions[i] - Vec3(2, 0, 2)) * Vec3(1, 0, 1));
    const Atlas atlas = make_atlas(made.mesh, 850);
    const Texels texels = make_parted_texels(made.trace(), atlas);
    int curved = 0;
    for (std::uint32_t t = 0; t < texels.count(); ++t) {
        if (texels.position[t].y < 1.4f) continue;
        curved += glm::distance(texels.position[t], Vec3(2, texels.position[t].y, 2)) < 0.096f;
        EXPECT_EQ(texels.covered[t], 0) << t;
    }
    EXPECT_GT(curved, 3);
}

}  // namespace
}  // namespace daylit
