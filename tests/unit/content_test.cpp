// The demo level and the proof scenes: whole, walkable, closed where they must be, and the same bytes every time.
#include "content/content.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "content/blocks.h"
#include "content/opening.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/scene/gltf.h"
#include "engine/scene/pose.h"

namespace daylit {
namespace {

std::filesystem::path made(const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / ("content_test_" + name + ".glb");
    make_scene(name, path);
    return path;
}

struct Castle {
    std::filesystem::path path = made("koldinghus");
    Scene scene = load_scene(path);
    Pose pose = pose_scene(scene);
    WorldMesh mesh = world_mesh(scene, pose, Part::All);
};

const Castle& castle() {
    static const Castle one;
    return one;
}

// Sum over faces of the signed volume under them, and the number of edges whose two directions do not balance.
struct Closedness {
    double volume = 0.0;
    int open_edges = 0;
};

using Key = std::array<float, 3>;
Closedness closedness(const std::vector<Vec3>& positions, const std::vector<std::uint32_t>& indices) {
    Closedness result;
    std::map<std::pair<Key, Key>, int> balance;
    const auto key = [](const Vec3& p) { return Key{p.x, p.y, p.z}; };
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const Vec3 p[3] = {positions[indices[i]], positions[indices[i + 1]], positions[indices[i + 2]]};
        result.volume += double(glm::dot(p[0], glm::cross(p[1], p[2]))) / 6.0;
        for (int k = 0; k < 3; ++k) {
            const Key a = key(p[k]), b = key(p[(k + 1) % 3]);
            if (a < b)
                ++balance[{a, b}];
            else
                --balance[{b, a}];
        }
    }
    for (const auto& [edge, sum] : balance) result.open_edges += sum != 0;
    return result;
}

Closedness closedness(const WorldMesh& mesh) {
    return closedness(mesh.positions, mesh.indices);
}

Closedness closedness(const content::LevelMesh& mesh) {
    std::vector<Vec3> positions;
    std::vector<std::uint32_t> indices;
    for (const auto& [material, part] : mesh.parts) {
        for (std::uint32_t i : part.indices) indices.push_back(i + std::uint32_t(positions.size()));
        positions.insert(positions.end(), part.positions.begin(), part.positions.end());
    }
    return closedness(positions, indices);
}

// Nearest hit along a ray, both sides (Moeller and Trumbore 1997).
std::optional<float> hit(const WorldMesh& mesh, const Vec3& origin, const Vec3& direction, float limit) {
    std::optional<float> best;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3& a = mesh.positions[mesh.indices[i]];
        const Vec3 e = mesh.positions[mesh.indices[i + 1]] - a, f = mesh.positions[mesh.indices[i + 2]] - a;
        const Vec3 p = glm::cross(direction, f);
        const float det = glm::dot(e, p);
        if (std::abs(det) < 1e-12f) continue;
        const Vec3 s = origin - a, q = glm::cross(s, e);
        const float u = glm::dot(s, p) / det, v = glm::dot(direction, q) / det, t = glm::dot(f, q) / det;
        if (u < 0 || v < 0 || u + v > 1 || t <= 0 || t > best.value_or(limit)) continue;
        best = t;
    }
    return best;
}

TEST(Content, NamesAreUniqueAndUnknownOnesAreRefusedWithTheList) {
    std::set<std::string> names;
    for (const ContentScene& scene : content_scenes()) {
        EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
        EXPECT_FALSE(scene.purpose.empty()) << scene.name;
    }
    EXPECT_EQ(names.size(), 10u);
    try {
        make_scene("nowhere", "nowhere.glb");
        FAIL() << "an unknown name was accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("koldinghus"), std::string::npos) << error.what();
    }
    EXPECT_THROW(make_scene("furnace", "/no/such/folder/x.glb"), Error);
}

TEST(Content, ProofScenesLoadWithoutNotesAndHaveAView) {
    for (const ContentScene& entry : content_scenes()) {
        if (entry.name == "koldinghus") continue;
        const Scene scene = load_scene(made(entry.name));
        EXPECT_TRUE(scene.notes.empty()) << entry.name << ": " << scene.notes.front();
        EXPECT_NO_THROW(camera_view(scene, pose_scene(scene), "view")) << entry.name;
        EXPECT_TRUE(scene.extras.latitude.has_value()) << entry.name;
    }
}

TEST(Content, ClosedProofScenesHaveNoOpenEdgeAndTheVolumeOfTheirWalls) {
    // Walls' volume: outer box less the rooms, by hand. Furnace is seen from inside alone, hence negative.
    const std::map<std::string, double> volumes = {
        {"furnace", -4.0 * 3.0 * 5.0},
        {"sealed_room", 4.4 * 3.0 * 4.4 - 4.0 * 2.6 * 4.0},
        {"thin_wall", 6.4 * 3.0 * 4.4 - 2.0 * 2.99 * 2.6 * 4.0},
        {"two_rooms", 8.6 * 3.2 * 4.4 - 2.0 * 4.0 * 2.8 * 4.0 - 2.6 * 1.6 * 0.2},
        {"tunnel", 3.4 * 3.4 * 30.2 - 3.0 * 3.0 * 30.0}};
    for (const auto& [name, volume] : volumes) {
        const Scene scene = load_scene(made(name));
        const Closedness closed = closedness(world_mesh(scene, pose_scene(scene), Part::All));
        EXPECT_EQ(closed.open_edges, 0) << name;
        EXPECT_NEAR(closed.volume, volume, 1e-3 * std::abs(volume)) << name;
    }
}

TEST(Content, BlocksCarvedAndFilledAcrossEachOtherStayClosed) {
    content::Blocks blocks;
    const int solid = blocks.add_solid({0, 0, 0});
    blocks.fill({0, 0, 0}, {4, 3, 5}, solid);
    blocks.carve({0.5f, 0.5f, 0.5f}, {3.5f, 2.5f, 4.5f}, 0);  // 3 x 2 x 4
    blocks.carve({1, 0.5f, 4.5f}, {2, 2, 5}, 0);              // a door of 1 x 1.5 x 0.5
    blocks.fill({3, 1, 1}, {6, 2, 2}, solid);                 // 2 m stand out, 0.5 m stand in
    const Closedness closed = closedness(blocks.faces("blocks", 0));
    EXPECT_EQ(closed.open_edges, 0);
    EXPECT_NEAR(closed.volume, 60.0 - 24.0 - 0.75 + 2.0 + 0.5, 1e-4);
    EXPECT_TRUE(blocks.solid_at({0.2f, 1, 1}));
    EXPECT_FALSE(blocks.solid_at({2, 1, 3}));
    EXPECT_FALSE(blocks.solid_at({20, 1, 3}));
}

TEST(Content, KitShapesAreClosedAndFaceOutwards) {
    content::MeshBuilder b;
    // A cube less its bevels: each of 12 edges loses a prism of b^2/2, ends overlap in the corners.
    b.bevel_box({0, 0, 0}, {1, 1, 1}, 0.1f);
    Closedness closed = closedness(b.take("bevel box"));
    EXPECT_EQ(closed.open_edges, 0);
    EXPECT_GT(closed.volume, 1.0 - 12 * 0.005);
    EXPECT_LT(closed.volume, 1.0 - 12 * 0.005 * 0.8);
    b.cylinder({0, 0, 0}, 0.5f, 2.0f, 64);
    closed = closedness(b.take("cylinder"));
    EXPECT_EQ(closed.open_edges, 0);
    EXPECT_NEAR(closed.volume, 0.5 * 64 * 0.25 * std::sin(2 * kPi / 64) * 2.0, 1e-4);  // a 64-gon's prism
    b.torus({0, 0, 0}, 1.0f, 0.25f, 96, 48);
    closed = closedness(b.take("torus"));
    EXPECT_EQ(closed.open_edges, 0);
    EXPECT_NEAR(closed.volume, 2 * kPi * kPi * 0.0625, 0.01);
    b.beam({0, 0, 0}, {1, 2, 2}, 0.1f, 0.2f);
    closed = closedness(b.take("beam"));
    EXPECT_NEAR(closed.volume, 3.0 * 0.02, 0.0006);
}

TEST(Content, OpeningsFillTheWallAroundTheirOutlines) {
    // A wall of 4 x 4 x 1 with a round window of 1.2 m whose reveal is straight: what is left is wall less cylinder.
    content::Blocks blocks;
    const int solid = blocks.add_solid({0, 0, 0});
    blocks.fill({-2, 0, -1}, {2, 4, 0}, solid);
    content::MeshBuilder b;
    const std::vector<Vec2> circle = content::circle_outline(0.6f, 2.0f);
    content::add_opening(blocks, b, {.origin = {0, 0, 0}, .loops = {{0.0f, circle}, {1.0f, circle}}});
    double area = 0.0;
    for (std::size_t i = 0; i < circle.size(); ++i) {
        const Vec2 p = circle[i], q = circle[(i + 1) % circle.size()];
        area += 0.5 * double(p.x * q.y - q.x * p.y);
    }
    EXPECT_NEAR(closedness(blocks.faces("wall", 0)).volume + closedness(b.take("rest")).volume, 16.0 - area, 1e-3);
}

TEST(Content, CastleLoadsWithoutNotesWithinItsBudget) {
    const Castle& c = castle();
    EXPECT_TRUE(c.scene.notes.empty()) << c.scene.notes.front();
    EXPECT_GE(c.mesh.triangle_count(), 50000u);
    EXPECT_LE(c.mesh.triangle_count(), 150000u);
    EXPECT_LE(std::filesystem::file_size(c.path), 30u << 20);
    EXPECT_EQ(c.scene.extras.latitude.value_or(0), 55.4917);
    EXPECT_EQ(c.scene.extras.utc_offset.value_or(0), 2.0);
    EXPECT_EQ(c.scene.animations.size(), 4u);
    ASSERT_EQ(c.scene.skins.size(), 1u);
    EXPECT_GE(c.scene.skins[0].joints.size(), 10u);
    std::set<std::string> names;
    for (const Node& node : c.scene.nodes) EXPECT_TRUE(names.insert(node.name).second) << "twice: " << node.name;
}

TEST(Content, CastleHasACameraForEveryRoomAndPhenomenonClearOfWalls) {
    const Castle& c = castle();
    const Bounds box = bounds(c.mesh);
    for (const char* name :
         {"hall", "hall_windows", "hall_evening", "treasury", "brass", "glass", "courtyard", "arcade",
          "cellar_entrance", "cellar_maze", "door", "cart", "figure", "tower", "overview"}) {
        const View view = camera_view(c.scene, c.pose, name);
        EXPECT_TRUE(glm::all(glm::greaterThan(view.eye, box.min)) && glm::all(glm::lessThan(view.eye, box.max)))
            << name;
        const ViewRay ahead = view_ray(view, 32, 18, 64, 36);
        const std::optional<float> distance = hit(c.mesh, ahead.origin, ahead.direction, 200.0f);
        ASSERT_TRUE(distance.has_value()) << name << " looks into the void";
        EXPECT_GT(*distance, 1.0f) << name << " stands before a wall";
        // Inside a wall, the nearest surface would be close on every side.
        for (const Vec3& side :
             {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
            EXPECT_GT(hit(c.mesh, view.eye, side, 0.2f).value_or(1.0f), 0.15f) << name;
    }
}

TEST(Content, OneCanWalkFromTheGateThroughEveryRoom) {
    const Castle& c = castle();
    // The door stands half open and people move: only what is fixed counts.
    const WorldMesh fixed = world_mesh(c.scene, c.pose, Part::Static);
    const std::vector<std::vector<Vec2>> ways = {
        {{-30, -4.5f}, {-8, -4.5f}, {4, -2}, {6.2f, 8}, {6.2f, 14}, {12, 14.9f}},  // gate, courtyard, hall, dais
        {{6, 5.5f}, {16.5f, 5.5f}, {19, 4}},                                       // courtyard, treasury
        {{-8, -4.5f}, {-8, -12}, {8, -12}},                                        // arcade
        {{-11, 9.5f}, {-13.2f, 8}, {-13.2f, -0.2f}, {-11, -0.2f}, {-11, 4.55f}, {-6.6f, 4.55f}}};  // stairs, maze
    WorldMesh around = fixed;  // with only the triangles near the present stretch
    const auto keep_near = [&](const Vec2& a, const Vec2& b) {
        around.indices.clear();
        for (std::size_t i = 0; i < fixed.indices.size(); i += 3) {
            Bounds box;
            for (std::size_t k = 0; k < 3; ++k) box.add(fixed.positions[fixed.indices[i + k]]);
            const bool far = box.max.x < std::min(a.x, b.x) || box.min.x > std::max(a.x, b.x) ||
                             box.max.z < std::min(a.y, b.y) || box.min.z > std::max(a.y, b.y);
            if (!far) around.indices.insert(around.indices.end(), &fixed.indices[i], &fixed.indices[i] + 3);
        }
    };
    const auto floor_below = [&](Vec2 p, float from) {
        const std::optional<float> d = hit(around, {p.x, from, p.y}, {0, -1, 0}, 30.0f);
        return d ? from - *d : -100.0f;
    };
    for (const auto& way : ways) {
        keep_near(way[0], way[0]);
        float foot = floor_below(way[0], 1.0f);
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            keep_near(way[i], way[i + 1]);
            const int steps = int(glm::length(way[i + 1] - way[i]) / 0.1f) + 1;
            for (int k = 1; k <= steps; ++k) {
                const Vec2 p = glm::mix(way[i], way[i + 1], float(k) / float(steps));
                const float next = floor_below(p, foot + 0.9f);
                ASSERT_LE(std::abs(next - foot), 0.2f) << "step at " << p.x << ", " << p.y;
                foot = next;
                EXPECT_FALSE(hit(around, {p.x, foot + 0.3f, p.y}, {0, 1, 0}, 1.7f)) << "head at " << p.x << ", " << p.y;
            }
        }
    }
}

TEST(Content, CastleHasTheSameBytesWithOneThread) {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const std::filesystem::path again = std::filesystem::path(testing::TempDir()) / "content_test_again.glb";
    make_scene("koldinghus", again);
    EXPECT_TRUE(read_file(again) == read_file(castle().path));
}

}  // namespace
}  // namespace daylit
