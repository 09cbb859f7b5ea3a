// Texels beside thin walls: no texel's points lie on both sides, and rays find the side that they came to.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

#include "engine/base/random.h"
#include "gi/surface/parting.h"
#include "scenes.h"

namespace daylit {
namespace {

constexpr float kThick = 0.02f;                                        // of the wall, metres
constexpr std::array<float, 4> kPlaces = {1.9f, 1.94f, 1.97f, 2.01f};  // along x; some texels begin between any two

/// A floor of 4 m with or without a wall across it.
TestScene floor_of_four_metres(std::optional<float> wall) {
    TestScene made;
    const std::uint32_t grey = made.add(lambert(Rgb(0.5f)));
    made.quad(grey, Vec3(0.0f), Vec3(0, 0, 4), Vec3(4, 0, 0));
    if (wall) made.box(grey, Vec3(*wall, 0, -1), Vec3(*wall + kThick, 2, 5));
    return made;
}

struct Floor {
    explicit Floor(std::optional<float> wall)
        : made(floor_of_four_metres(wall)),
          rays(made.scene, made.mesh),
          atlas(make_atlas(made.mesh, 2000)),
          texels(make_parted_texels(rays, atlas)) {}

    TestScene made;
    RayScene rays;
    Atlas atlas;
    Texels texels;
};

/// -1 and 1: the sides; 0: under the wall.
int side(float wall, const Vec3& place) {
    return place.x < wall ? -1 : place.x > wall + kThick ? 1 : 0;
}

TEST(Parting, NoTexelLiesOnBothSidesOfAWall) {
    int parted = 0;
    for (const float wall : kPlaces) {
        const Floor floor(wall);
        for (std::uint32_t t = 0; t < floor.texels.count(); ++t) {
            parted += floor.texels.next_part[t] != kNoTexel;
            if (floor.texels.normal[t].y < 0.9f || floor.texels.position[t].y > 0.01f) continue;
            int least = 1, most = -1;
            for (const TexelPoint& p : floor.texels.points_of(t)) {
                const int s = side(wall, position(floor.made.mesh, p));
                if (s != 0) least = std::min(least, s), most = std::max(most, s);
            }
            EXPECT_FALSE(least < 0 && most > 0) << wall << " " << t;
        }
    }
    EXPECT_GT(parted, 20);  // rows of them at some of the places
}

TEST(Parting, WhereNothingStandsNoTexelIsParted) {
    const Floor floor(std::nullopt);
    for (std::uint32_t t = 0; t < floor.texels.count(); ++t) {
        EXPECT_EQ(floor.texels.next_part[t], kNoTexel);
        EXPECT_EQ(floor.texels.walled[t], 0);
    }
}

TEST(Parting, RaysFindTexelsOnTheSideThatTheyCameTo) {
    Random random(3, 0, 0);
    int asked = 0;
    for (const float wall : kPlaces) {
        const Floor floor(wall);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 from(wall + 0.3f * (random.next() - 0.5f), 1.0f, 0.3f + 3.4f * random.next());
            const Ray ray{from, Vec3(0, -1, 0)};
            const auto met = floor.rays.closest(ray, 0);
            if (side(wall, from) == 0 || !met) continue;
            ++asked;
            const Vec3 place = ray.origin + met->distance * ray.direction;
            const std::uint32_t texel =
                texel_in_sight(floor.rays, floor.atlas, floor.texels, met->triangle, met->barycentric, place, false);
            ASSERT_NE(texel, kNoTexel);
            for (const TexelPoint& p : floor.texels.points_of(texel))
                EXPECT_NE(side(wall, position(floor.made.mesh, p)), -side(wall, place)) << wall << " " << place.x;
        }
    }
    EXPECT_GT(asked, 3000);
}

}  // namespace
}  // namespace daylit
