// The atlas: nothing overlaps, nothing is left out, and a fetch never leaves its chart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/random.h"
#include "gi/surface/atlas.h"
#include "gi/surface/raster.h"
#include "gi/surface/texels.h"
#include "tests/physics/scenes.h"

namespace daylit {
namespace {

void add_triangle(WorldMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {a, b, c}) {
        mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
        mesh.positions.push_back(p);
        mesh.normals.push_back(Vec3(0, 1, 0));
    }
    mesh.materials.push_back(0);
    mesh.nodes.push_back(0);
}

void add_quad(WorldMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

/// Two turns of a ramp about the vertical: seen from above its turns cover each other.
WorldMesh spiral() {
    WorldMesh mesh;
    const auto rim = [](int i, float radius) {
        const float turn = float(i) * float(kPi) / 16.0f;
        return Vec3(radius * std::cos(turn), 0.08f * float(i), -radius * std::sin(turn));
    };
    for (int i = 0; i < 64; ++i) add_quad(mesh, rim(i, 1.0f), rim(i, 2.0f), rim(i + 1, 2.0f), rim(i + 1, 1.0f));
    return mesh;
}

WorldMesh ball() {
    WorldMesh mesh;
    const auto at = [](int i, int j) {
        const float polar = float(i) * float(kPi) / 16.0f, turn = float(j) * float(kPi) / 16.0f;
        return Vec3(std::sin(polar) * std::cos(turn), std::cos(polar), -std::sin(polar) * std::sin(turn));
    };
    for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 32; ++j) add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    return mesh;
}

/// Triangles of all shapes and sizes at random, slivers among them, and one without area.
WorldMesh gravel() {
    WorldMesh mesh;
    Random random(7, 0, 0);
    const auto any = [&] { return Vec3(random.next(), random.next(), random.next()) - 0.5f; };
    for (int i = 0; i < 300; ++i) {
        const Vec3 middle = 20.0f * any();
        const float size = std::exp2(8.0f * random.next() - 6.0f);
        const Vec3 a = middle + size * any(), b = middle + size * any();
        add_triangle(mesh, a, b, i % 10 == 0 ? glm::mix(a, b, 0.5f) + 1e-3f * any() : middle + size * any());
    }
    add_triangle(mesh, Vec3(1), Vec3(1), Vec3(2));
    return mesh;
}

class Unwrap : public testing::TestWithParam<WorldMesh (*)()> {};

TEST_P(Unwrap, EveryTriangleWithAreaHasOneChartAndStaysInTheAtlas) {
    const WorldMesh mesh = GetParam()();
    const Atlas atlas = make_atlas(mesh, 4000);
    const std::vector<Facet> facet = facets(mesh);
    ASSERT_EQ(atlas.corner_uvs.size(), 3 * mesh.triangle_count());
    std::map<std::uint32_t, int> times;
    for (const PlacedChart& c : atlas.charts)
        for (std::uint32_t t : c.chart.triangles) ++times[t];
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
        EXPECT_EQ(times[t], facet[t].area > 0.0f ? 1 : 0) << "triangle " << t;
    for (const Vec2& uv : atlas.corner_uvs) {
        EXPECT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
    }
}

TEST_P(Unwrap, NoTexelCentreLiesInTwoTriangles) {
    const WorldMesh mesh = GetParam()();
    const Atlas atlas = make_atlas(mesh, 4000);
    std::map<std::pair<long, long>, std::uint32_t> owner;
    int covered = 0;
    for (const PlacedChart& c : atlas.charts) {
        if (c.nx == 1 || c.ny == 1) continue;  // drawn on a line: its triangles share the texels by design
        for (std::uint32_t t : c.chart.triangles) {
            std::array<Vec2, 3> p;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] = atlas.corner_uvs[3 * t + k] * Vec2(float(atlas.width), float(atlas.height));
            for_cells_inside(p, 1e-2, [&](long x, long y) {
                ++covered;
                EXPECT_TRUE(owner.try_emplace({x, y}, t).second) << "triangle " << t << " and " << owner[{x, y}];
                return true;
            });
        }
    }
    EXPECT_GT(covered, 300);
}

TEST_P(Unwrap, FetchesStayInTheirChart) {
    const WorldMesh mesh = GetParam()();
    const Atlas atlas = make_atlas(mesh, 4000);
    Random random(1, 0, 0);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        if (atlas.chart_of_triangle[t] == kNoChart) continue;
        const PlacedChart& c = atlas.charts[atlas.chart_of_triangle[t]];
        for (int i = 0; i < 4; ++i) {
            const float root = std::sqrt(random.next()), share = random.next();
            const Vec2 uv = (1 - root) * atlas.corner_uvs[3 * t] + root * (1 - share) * atlas.corner_uvs[3 * t + 1] +
                            root * share * atlas.corner_uvs[3 * t + 2];
            const Vec2 low = uv * Vec2(float(atlas.width), float(atlas.height)) - 0.5f;
            EXPECT_GE(int(std::floor(low.x)), c.x);
            EXPECT_GE(int(std::floor(low.y)), c.y);
            EXPECT_LT(int(std::floor(low.x)) + 1, c.x + c.atlas_width());
            EXPECT_LT(int(std::floor(low.y)) + 1, c.y + c.atlas_height());
        }
    }
}

/// As vertices keep coordinates (engine/render/draw_mesh.cpp), and as a GPU reads them.
Vec2 in_16_bits(const Vec2& uv) {
    return glm::round(uv * 65535.0f) / 65535.0f;
}

/// Texels, the least of all corners, from the outermost texel centres of its chart; negative outside.
float nearest_to_a_rim(const Atlas& atlas) {
    const Vec2 size(float(atlas.width), float(atlas.height));
    float nearest = INFINITY;
    for (const PlacedChart& c : atlas.charts) {
        const Vec2 first = Vec2(float(c.x), float(c.y)) + 0.5f,
                   last = first + Vec2(float(c.atlas_width() - 1), float(c.atlas_height() - 1));
        for (const std::uint32_t t : c.chart.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2 place = in_16_bits(atlas.corner_uvs[3 * std::size_t(t) + k]) * size;
                const Vec2 away = glm::min(place - first, last - place);
                nearest = std::min({nearest, away.x, away.y});
            }
    }
    return nearest;
}

// A filter of 8 bits that is asked for a place within 1/256 texel of a centre may take some of the texel beyond.
constexpr float kAway = 1.0f / 128.0f;

TEST_P(Unwrap, RoundedCornersKeepAwayFromNeighboursInTheAtlas) {
    const WorldMesh mesh = GetParam()();
    for (const std::size_t texels : {300u, 4000u, 60000u}) EXPECT_GE(nearest_to_a_rim(make_atlas(mesh, texels)), kAway);
}

// Coordinates are rounded to a share of the atlas's side, so in a large one by more of a texel.
TEST(UnwrapLarge, RoundedCornersKeepAwayFromNeighboursInTheAtlas) {
    const Atlas atlas = make_atlas(gravel(), 1800000);
    ASSERT_GT(std::max(atlas.width, atlas.height), 1400);
    EXPECT_GE(nearest_to_a_rim(atlas), kAway);
}

TEST_P(Unwrap, EveryTriangleHasTexelsNearIt) {
    const WorldMesh mesh = GetParam()();
    const Atlas atlas = make_atlas(mesh, 4000);
    const Texels texels = make_texels(mesh, atlas);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        if (atlas.chart_of_triangle[t] == kNoChart) continue;
        const TexelPoint centroid{t, Vec2(1.0f / 3.0f)};
        const std::uint32_t texel = texels.at(atlas, t, centroid.barycentric);
        ASSERT_NE(texel, kNoTexel);
        EXPECT_EQ(texels.chart[texel], atlas.chart_of_triangle[t]);
        EXPECT_FALSE(texels.points_of(texel).empty());
        EXPECT_LE(texels.points_of(texel).size(), 16u);
    }
}

std::string surface_name(const testing::TestParamInfo<WorldMesh (*)()>& info) {
    return info.index == 0 ? "Spiral" : info.index == 1 ? "Ball" : "Gravel";
}
INSTANTIATE_TEST_SUITE_P(Surfaces, Unwrap, testing::Values(&spiral, &ball, &gravel), surface_name);

TEST(UnwrapBox, ABoxTakesSixCharts) {
    WorldMesh mesh;
    const Vec3 p[8] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const int faces[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {2, 3, 7, 6}, {1, 2, 6, 5}, {3, 0, 4, 7}};
    for (const auto& f : faces) add_quad(mesh, p[f[0]], p[f[1]], p[f[2]], p[f[3]]);
    const Atlas atlas = make_atlas(mesh, 600);
    ASSERT_EQ(atlas.charts.size(), 6u);
    for (const PlacedChart& c : atlas.charts) {
        EXPECT_NEAR(c.chart.size.x, 1.0f, 1e-5f);  // turned along its edges, not its diagonal
        EXPECT_NEAR(c.chart.size.y, 1.0f, 1e-5f);
        EXPECT_EQ(c.nx, 10);
    }
}

/// A wall of 4 x 4 m that looks along z, and beside it two of half its height.
WorldMesh cut_wall() {
    WorldMesh mesh;
    const auto quad = [&](const Vec2& a, const Vec2& b) {
        add_quad(mesh, Vec3(a, 0), Vec3(b.x, a.y, 0), Vec3(b, 0), Vec3(a.x, b.y, 0));
    };
    quad({0, 0}, {4, 4}), quad({4, 0}, {6, 2}), quad({4, 2}, {6, 4});
    return mesh;
}

TEST(UnwrapCutWall, PiecesThatTouchAlongPartsOfEdgesAreOneChart) {
    for (const Vec3& away : {Vec3(0.0f), Vec3(0.3f, 57.1f, -0.7f), Vec3(1e4f, -333.3f, 1e3f)}) {
        WorldMesh mesh = cut_wall();
        for (Vec3& p : mesh.positions) p += away;
        EXPECT_EQ(grow_charts(mesh, 0.1f).size(), 1u) << away.x;
    }
}

TEST(UnwrapCutWall, PiecesInOtherPlanesOrApartOrTurnedAwayAreNot) {
    const std::size_t small = 6;  // the first corner of the two lesser quads
    const auto charts = [&](const auto& change) {
        WorldMesh mesh = cut_wall();
        for (std::size_t i = small; i < mesh.positions.size(); ++i) mesh.positions[i] = change(mesh.positions[i]);
        return grow_charts(mesh, 0.1f).size();
    };
    EXPECT_EQ(charts([](const Vec3& p) { return p + Vec3(0, 0, 0.01f); }), 2u);
    EXPECT_EQ(charts([](const Vec3& p) { return p + Vec3(0.01f, 0, 0); }), 2u);
    EXPECT_EQ(charts([](const Vec3& p) { return Vec3(p.x, 4.0f - p.y, p.z); }), 2u);         // seen from behind
    EXPECT_EQ(charts([](const Vec3& p) { return p + 0.1f * Vec3(0, 0, p.x - 4.0f); }), 2u);  // bends away
}

TEST(UnwrapCutWall, ASmallPieceMayBeHiddenAndALargeOneNot) {
    const WorldMesh mesh = cut_wall();
    std::vector<Surroundings> around(mesh.triangle_count(), {.nearness = 1.0f});
    around[5].hidden = true;  // 2 square metres
    EXPECT_EQ(grow_charts(mesh, 0.4f, around).size(), 1u);
    EXPECT_EQ(grow_charts(mesh, 0.1f, around).size(), 2u);
}

TEST(UnwrapCrease, AFloorAndASlopeAreOneChartWhereTheyAreShadedAsOne) {
    WorldMesh mesh;
    add_quad(mesh, Vec3(0, 0, 0), Vec3(0, 0, 2), Vec3(2, 0, 2), Vec3(2, 0, 0));
    add_quad(mesh, Vec3(2, 0, 0), Vec3(2, 0, 2), Vec3(4, 1.3f, 2), Vec3(4, 1.3f, 0));  // 33 degrees
    EXPECT_EQ(grow_charts(mesh, 0.1f).size(), 1u);
    const std::vector<Facet> facet = facets(mesh);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.normals[mesh.indices[i]] = facet[i / 3].normal;
    EXPECT_EQ(grow_charts(mesh, 0.1f).size(), 2u);
}

TEST(UnwrapMany, AMillionTinyChartsTakeOneTexelEach) {
    WorldMesh mesh;
    for (int i = 0; i < 1000; ++i)
        for (int k = 0; k < 1000; ++k) {
            const Vec3 p(0.01f * float(i), 0.0f, 0.01f * float(k));
            add_triangle(mesh, p, p + Vec3(0, 0, 0.001f), p + Vec3(0.001f, 0, 0));
        }
    const Atlas atlas = make_atlas(mesh, 24000);
    EXPECT_EQ(atlas.charts.size(), 1000000u);
    EXPECT_LE(std::size_t(atlas.width) * std::size_t(atlas.height), 4200000u);  // two by two, for their fetches
    EXPECT_EQ(make_texels(mesh, atlas).count(), 1000000u);
}

// Between plates at distance d, 1 / r = cos / d; its cosine-weighted mean is 2 / (3 d).
TEST(LookAround, NearnessBetweenParallelPlates) {
    TestScene made;
    const std::uint32_t grey = made.add(lambert(Rgb(0.5f)));
    made.quad(grey, Vec3(0, 0, 0), Vec3(0, 0, 400), Vec3(400, 0, 0));
    made.quad(grey, Vec3(0, 2, 0), Vec3(400, 0, 0), Vec3(0, 0, 400));
    for (const Surroundings& around : look_around(made.trace(), 2.0f)) {
        EXPECT_FALSE(around.hidden);
        EXPECT_NEAR(around.nearness, 2.0f / (3.0f * 2.0f), 0.01f);
    }
}

TEST(LookAround, LooksThroughTheShareThatIsGlass) {
    TestScene made;
    Material sheet = glass(1.5f);
    sheet.transmission = 0.25f;
    made.quad(made.add(lambert(Rgb(0.5f))), Vec3(0, 0, 0), Vec3(0, 0, 400), Vec3(400, 0, 0));
    made.quad(made.add(sheet), Vec3(0, 2, 0), Vec3(400, 0, 0), Vec3(0, 0, 400));
    const std::vector<Surroundings> around = look_around(made.trace(), 2.0f);
    for (std::size_t t = 0; t < 2; ++t) EXPECT_NEAR(around[t].nearness, 0.75f * 2.0f / (3.0f * 2.0f), 0.01f);
}

TEST(LookAround, InsideASolidIsHiddenAndTheOpenIsNot) {
    TestScene made;
    const std::uint32_t grey = made.add(lambert(Rgb(0.5f)));
    made.box(grey, Vec3(-1), Vec3(1));
    made.quad(grey, Vec3(-0.5f, 0, -0.5f), Vec3(0, 0, 1), Vec3(1, 0, 0));
    const std::vector<Surroundings> around = look_around(made.trace(), 0.1f);
    for (std::size_t t = 0; t < around.size(); ++t) EXPECT_EQ(around[t].hidden, t >= 12) << t;
}

TEST(LookAround, TexelsAreFineAcrossAContactAndCoarseInTheOpenAndWhereNobodyCanLook) {
    TestScene made;
    const std::uint32_t grey = made.add(lambert(Rgb(0.5f)));
    made.quad(grey, Vec3(-50, 0, -50), Vec3(0, 0, 100), Vec3(100, 0, 0));  // the ground
    made.quad(grey, Vec3(-5, 0, 0), Vec3(10, 0, 0), Vec3(0, 2, 0));        // a wall upon it
    made.quad(grey, Vec3(-5, 300, 0), Vec3(10, 0, 0), Vec3(0, 2, 0));      // and one far from everything
    made.box(grey, Vec3(20, 100, 20), Vec3(24, 104, 24));
    made.quad(grey, Vec3(20.5f, 102, 20.5f), Vec3(0, 0, 3), Vec3(3, 0, 0));
    const std::vector<Surroundings> around = look_around(made.trace(), 0.5f);
    const Atlas atlas = make_atlas(made.mesh, 20000, around);
    const auto placed = [&](std::uint32_t triangle) { return atlas.charts[atlas.chart_of_triangle[triangle]]; };
    const PlacedChart wall = placed(2), far = placed(4), hidden = placed(18);
    const bool upright = std::abs(wall.chart.axis_v.y) > 0.5f;
    const float across = upright ? wall.step.y : wall.step.x, along = upright ? wall.step.x : wall.step.y;
    EXPECT_LT(1.5f * across, along);
    EXPECT_LT(1.5f * across, std::min(far.step.x, far.step.y));
    EXPECT_LT(wall.step.x * wall.step.y, 0.5f * far.step.x * far.step.y);
    EXPECT_LE(hidden.nx * hidden.ny, 9);
    std::size_t texels = 0;
    for (const PlacedChart& c : atlas.charts) texels += std::size_t(c.nx) * std::size_t(c.ny);
    EXPECT_LE(texels, 20000u);
    EXPECT_GE(texels, 15000u);
}

}  // namespace
}  // namespace daylit
