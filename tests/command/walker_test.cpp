// The walk's physics in small made-up places.
#include "demo/walk/walker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace daylit {
namespace {

/// Collects rectangles; what a test walks about in.
class Place {
  public:
    Place& quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
        const auto first = std::uint32_t(mesh_.positions.size());
        for (const Vec3& corner : {a, b, c, d}) mesh_.positions.push_back(corner);
        for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh_.indices.push_back(first + i);
        mesh_.materials.insert(mesh_.materials.end(), 2, 0);
        return *this;
    }
    Place& floor(float y, float x0 = -50, float x1 = 50, float z0 = -50, float z1 = 50) {
        return quad({x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0});
    }
    /// Across the way ahead (-Z) at this z.
    Place& wall(float z, float y0 = 0, float y1 = 5, float x0 = -50, float x1 = 50) {
        return quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
    }
    Place& side_wall(float x, float z0 = -50, float z1 = 50) {
        return quad({x, 0, z0}, {x, 0, z1}, {x, 5, z1}, {x, 5, z0});
    }
    Collider collider() const { return Collider(mesh_); }

  private:
    WorldMesh mesh_;
};

const Vec3 kEye(0.0f, 1.62f, 0.0f);
const Steering kStand{};
const Steering kAhead{.move = Vec3(0, 0, 1)};
const Steering kRun{.move = Vec3(0, 0, 1), .run = true};

void advance(Walker& walker, const Steering& steering, double seconds, float frame = 1.0f / 60) {
    for (int i = 0; i < int(std::lround(seconds / frame)); ++i) walker.advance(steering, frame);
}

TEST(Walker, falls_onto_the_floor_and_stays) {
    const Collider level = Place().floor(0).collider();
    Walker walker(level, kEye + Vec3(0, 2, 0));
    EXPECT_FALSE(walker.on_floor());
    advance(walker, kStand, 0.5);
    EXPECT_NEAR(walker.feet().y, 2 - 0.5f * 9.81f * 0.25f, 0.05f);
    advance(walker, kStand, 1);
    EXPECT_TRUE(walker.on_floor());
    EXPECT_NEAR(walker.feet().y, 0, 1e-4f);
    EXPECT_NEAR(walker.eye().y, 1.62f, 1e-3f);
}

TEST(Walker, walks_and_runs_at_its_speeds) {
    const Collider level = Place().floor(0).collider();
    Walker walker(level, kEye), runner(level, kEye);
    advance(walker, kAhead, 2);
    advance(runner, kRun, 2);
    EXPECT_NEAR(walker.feet().z, -2.2f * (2 - 0.08f), 0.05f);
    EXPECT_NEAR(runner.feet().z, -5.5f * (2 - 0.08f), 0.1f);
    EXPECT_NEAR(walker.feet().x, 0, 1e-4f);
    Steering diagonal{.move = Vec3(1, 0, 1), .yaw = 0};
    Walker aslant(level, kEye);
    advance(aslant, diagonal, 2);
    EXPECT_NEAR(glm::length(aslant.feet()), 2.2f * (2 - 0.08f), 0.05f) << "no faster on the diagonal";
}

TEST(Walker, yaw_turns_to_the_left) {
    const Collider level = Place().floor(0).collider();
    Walker walker(level, kEye);
    advance(walker, {.move = Vec3(0, 0, 1), .yaw = float(kPi / 2)}, 1);
    EXPECT_LT(walker.feet().x, -1.5f);
    EXPECT_NEAR(walker.feet().z, 0, 1e-3f);
}

TEST(Walker, stops_at_a_wall_from_either_side) {
    const Collider level = Place().floor(0).wall(-2).wall(2).collider();
    Walker walker(level, kEye);
    advance(walker, kRun, 3);
    EXPECT_NEAR(walker.feet().z, -2 + walker.shape().radius, 0.01f);
    advance(walker, {.move = Vec3(0, 0, -1), .run = true}, 3);
    EXPECT_NEAR(walker.feet().z, 2 - walker.shape().radius, 0.01f);
    EXPECT_TRUE(walker.on_floor());
}

TEST(Walker, slides_along_a_wall) {
    const Collider level = Place().floor(0).wall(-1).collider();
    Walker walker(level, kEye);
    // 30 degrees off the wall's direction: cos(30 deg) of the speed is left.
    advance(walker, {.move = Vec3(0, 0, 1), .yaw = float(60 * kDegree)}, 4);
    EXPECT_NEAR(walker.feet().z, -1 + walker.shape().radius, 0.01f);
    EXPECT_LT(walker.feet().x, -2.2f * 0.8f * 3);
}

TEST(Walker, a_corner_stops_it) {
    const Collider level = Place().floor(0).wall(-1).side_wall(-1).collider();
    Walker walker(level, kEye);
    advance(walker, {.move = Vec3(0, 0, 1), .yaw = float(40 * kDegree), .run = true}, 4);
    EXPECT_NEAR(walker.feet().z, -1 + walker.shape().radius, 0.02f);
    EXPECT_NEAR(walker.feet().x, -1 + walker.shape().radius, 0.02f);
}

TEST(Walker, climbs_steps_of_0_3_m_but_not_of_0_6_m) {
    for (const float riser : {0.18f, 0.3f, 0.6f}) {
        Place place;
        place.floor(0);
        for (int i = 0; i < 4; ++i) {
            const float z = -1.0f - 0.4f * float(i), y = riser * float(i);
            place.wall(z, y, y + riser).floor(y + riser, -50, 50, i == 3 ? -50 : z - 0.4f, z);
        }
        const Collider level = place.collider();
        Walker walker(level, kEye);
        advance(walker, kAhead, 4);
        if (riser < 0.4f) {
            EXPECT_NEAR(walker.feet().y, 4 * riser, 1e-3f) << riser;
            EXPECT_LT(walker.feet().z, -3) << riser;
            advance(walker, {.move = Vec3(0, 0, -1)}, 4);
            EXPECT_NEAR(walker.feet().y, 0, 1e-3f) << "down again";
        } else {
            EXPECT_NEAR(walker.feet().y, 0, 1e-3f);
            EXPECT_GT(walker.feet().z, -1);
        }
    }
}

TEST(Walker, the_camera_climbs_smoothly) {
    const Collider level = Place().floor(0).wall(-1, 0, 0.3f).floor(0.3f, -50, 50, -50, -1).collider();
    Walker walker(level, kEye);
    float largest = 0, before = walker.eye().y;
    for (int i = 0; i < 120; ++i) {
        walker.advance(kAhead, 1.0f / 60);
        largest = std::max(largest, std::abs(walker.eye().y - before));
        before = walker.eye().y;
    }
    EXPECT_NEAR(before, 1.92f, 1e-3f);
    EXPECT_LT(largest, 0.08f) << "metres in one frame";
}

TEST(Walker, slopes_of_30_degrees_carry_and_of_65_do_not) {
    const auto climbed = [](double degrees) {
        const float rise = 10 * float(std::tan(degrees * kDegree));
        const Collider level =
            Place().floor(0).quad({-50, 0, -1}, {50, 0, -1}, {50, rise, -11}, {-50, rise, -11}).collider();
        Walker walker(level, kEye);
        advance(walker, kAhead, 3);
        return walker.feet().y;
    };
    EXPECT_GT(climbed(30), 2.0f);
    EXPECT_LT(climbed(65), 0.8f);
}

TEST(Walker, a_jump_carries_0_9_m_and_a_ceiling_ends_it) {
    const auto highest = [](const Collider& level) {
        Walker walker(level, kEye);
        float top = 0;
        for (int i = 0; i < 60; ++i) {
            walker.advance({.jump = i == 0}, 1.0f / 60);
            top = std::max(top, walker.feet().y);
        }
        EXPECT_TRUE(walker.on_floor());
        return top;
    };
    EXPECT_NEAR(highest(Place().floor(0).collider()), 4.2 * 4.2 / (2 * 9.81), 0.05);
    EXPECT_NEAR(highest(Place().floor(0).floor(2).collider()), 2 - 1.75, 0.02);
}

TEST(Walker, a_low_passage_stops_it) {
    const Collider level = Place().floor(0).floor(1.5f, -50, 50, -50, -1).wall(-1, 1.5f, 5).collider();
    Walker walker(level, kEye);
    advance(walker, kRun, 3);
    EXPECT_GT(walker.feet().z, -1.0f);
    EXPECT_NEAR(walker.feet().y, 0, 1e-3f);
}

TEST(Walker, no_tunnelling_at_speed_and_at_4_frames_a_second) {
    // A fall of a kilometre onto a sheet, and runs against a sheet at hitching frames from many directions.
    const Collider sheet = Place().floor(0).collider();
    Walker faller(sheet, kEye + Vec3(0, 3, 0));
    faller.advance(kStand, 10.0f);
    advance(faller, kStand, 5, 0.25f);
    EXPECT_NEAR(faller.feet().y, 0, 1e-3f);

    const Collider ring = Place().floor(0).wall(-3).wall(3).side_wall(-3).side_wall(3).collider();
    for (int i = 0; i < 64; ++i) {
        Walker runner(ring, kEye);
        Steering steering = kRun;
        steering.yaw = float(2 * kPi * i / 64);
        for (int frame = 0; frame < 40; ++frame) {
            steering.jump = frame % 3 == 0;
            runner.advance(steering, 0.25f);
        }
        EXPECT_LT(std::abs(runner.feet().x), 3) << i;
        EXPECT_LT(std::abs(runner.feet().z), 3) << i;
        EXPECT_GE(runner.feet().y, -1e-3f) << i;
    }
}

TEST(Walker, terminal_velocity_meets_a_sheet) {
    const Collider deep = Place().floor(-500).floor(0, 5, 6, 5, 6).collider();
    Walker walker(deep, kEye + Vec3(5.5f, 0, 5.5f));
    walker.advance({.move = Vec3(0, 0, 1), .run = true}, 0.25f);
    advance(walker, kAhead, 20, 0.1f);
    EXPECT_NEAR(walker.feet().y, -500, 1e-3f);
    EXPECT_TRUE(walker.on_floor());
}

TEST(Walker, flies_through_walls_and_along_its_gaze) {
    const Collider level = Place().floor(0).wall(-2).collider();
    Walker walker(level, kEye);
    walker.fly(true);
    advance(walker, {.move = Vec3(0, 0, 1), .pitch = float(30 * kDegree)}, 2);
    EXPECT_LT(walker.feet().z, -2);
    EXPECT_NEAR(walker.feet().y / -walker.feet().z, std::tan(30 * kDegree), 1e-3);
    walker.fly(false);
    advance(walker, kStand, 3);
    EXPECT_TRUE(walker.on_floor());
}

TEST(Walker, without_a_floor_it_starts_flying_and_comes_back_when_it_falls_off) {
    const Collider nothing{WorldMesh{}};
    Walker alone(nothing, kEye);
    EXPECT_TRUE(alone.flying());
    const Collider islet = Place().floor(0, -1, 1, -1, 1).collider();
    Walker walker(islet, kEye);
    EXPECT_FALSE(walker.flying());
    advance(walker, kRun, 1);
    EXPECT_LT(walker.feet().y, 0);
    advance(walker, kStand, 4);
    EXPECT_NEAR(glm::distance(walker.eye(), kEye), 0, 0.01f);
}

TEST(Collider, the_tree_finds_what_a_search_of_all_triangles_finds) {
    // A grid of unit tiles at heights that differ; the expected height is known from the tile's number.
    Place place;
    const auto height = [](int x, int z) { return float((x * 7 + z * 3) % 11); };
    for (int x = 0; x < 30; ++x) {
        for (int z = 0; z < 30; ++z) place.floor(height(x, z), float(x), float(x + 1), float(z), float(z + 1));
    }
    const Collider level = place.collider();
    for (int x = 0; x < 30; ++x) {
        for (int z = 0; z < 30; ++z) {
            const auto y = level.floor_height(float(x) + 0.3f, float(z) + 0.6f, -1, 20);
            ASSERT_TRUE(y);
            EXPECT_EQ(*y, height(x, z));
        }
    }
    EXPECT_FALSE(level.floor_height(-0.5f, 3, -1, 20));
    const auto contact = level.deepest_contact({Vec3(4.5f, height(4, 4) + 0.1f, 4.5f), 0.05f, 0.3f});
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->depth, 0.2f, 1e-5f);
}

TEST(Collider, bad_triangles_are_left_out) {
    WorldMesh mesh;
    mesh.positions = {Vec3(0), Vec3(1, 0, 0), Vec3(NAN, 0, 0), Vec3(2, 0, 0)};
    mesh.indices = {0, 1, 2, 0, 1, 3, 1, 1, 1};
    EXPECT_TRUE(Collider(mesh).empty());
}

}  // namespace
}  // namespace daylit
