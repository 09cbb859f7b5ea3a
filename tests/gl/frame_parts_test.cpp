// The parts of a frame that need no context: clusters, culling, cascades, the plan.
#include <gtest/gtest.h>

#include <set>

#include "engine/render/culling.h"
#include "engine/render/draw_mesh.h"
#include "engine/render/frame_plan.h"
#include "engine/render/mipmaps.h"
#include "engine/render/sun_reach.h"
#include "engine/render/sun_shadow.h"

namespace daylit {
namespace {

/// n x n unit squares of two triangles in the xz plane, materials in a checkerboard.
WorldMesh checkerboard(int n) {
    WorldMesh mesh;
    for (int z = 0; z < n; ++z)
        for (int x = 0; x < n; ++x) {
            const auto first = std::uint32_t(mesh.positions.size());
            for (const Vec2 corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
                mesh.positions.push_back({float(x) + corner.x, 0, float(z) + corner.y});
                mesh.normals.push_back({0, 1, 0});
                mesh.tangents.push_back(Vec4(0));
                mesh.uvs.push_back({});
                mesh.colors.push_back(Rgba(1));
            }
            for (const std::uint32_t i : {0u, 2u, 1u, 0u, 3u, 2u}) mesh.indices.push_back(first + i);
            for (int t = 0; t < 2; ++t) {
                mesh.materials.push_back(std::uint32_t((x + z) % 2));
                mesh.nodes.push_back(std::uint32_t(x / 8));
            }
        }
    return mesh;
}

TEST(DrawMesh, holds_every_triangle_once_by_material_in_tight_clusters) {
    const WorldMesh mesh = checkerboard(64);
    const DrawMesh draw = build_draw_mesh(mesh, nullptr, false);
    EXPECT_EQ(draw.indices.size(), mesh.indices.size());
    EXPECT_EQ(draw.positions.size(), mesh.positions.size());
    ASSERT_EQ(draw.batches.size(), 2u);
    std::multiset<std::pair<float, float>> corners, expected;
    for (const std::uint32_t i : draw.indices) corners.emplace(draw.positions[i].x, draw.positions[i].z);
    for (const std::uint32_t i : mesh.indices) expected.emplace(mesh.positions[i].x, mesh.positions[i].z);
    EXPECT_EQ(corners, expected);
    std::uint32_t next = 0;
    for (const Cluster& cluster : draw.clusters) {
        EXPECT_EQ(cluster.first, next);
        next += cluster.count;
        const Vec3 size = cluster.bounds.max - cluster.bounds.min;
        EXPECT_LT(size.x * size.z, 1200.0f);  // 256 squares of one colour cover twice their area
    }
    EXPECT_EQ(next, draw.indices.size());
}

TEST(DrawMesh, moving_names_the_places_left_and_reached) {
    WorldMesh mesh = checkerboard(16);
    DrawMesh draw = build_draw_mesh(mesh, nullptr, true);
    EXPECT_TRUE(move_draw_mesh(draw, mesh).empty());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (mesh.positions[v].x > 8.5f) mesh.positions[v].y += 3.0f;  // part of node 1
    const std::vector<Bounds> moved = move_draw_mesh(draw, mesh);
    ASSERT_EQ(moved.size(), 4u);  // two materials of one node, before and after
    for (std::size_t i = 0; i < moved.size(); i += 2) {
        EXPECT_EQ(moved[i].max.y, 0.0f);
        EXPECT_EQ(moved[i + 1].max.y, 3.0f);
        EXPECT_GE(moved[i].min.x, 8.0f);
    }
    const auto moves = [&](std::uint32_t node) {
        std::uint64_t sum = 0;
        for (const Cluster& cluster : draw.clusters) sum += cluster.node == node ? cluster.moves : 0;
        return sum;
    };
    EXPECT_EQ(moves(0), 0u);
    EXPECT_EQ(moves(1), 2u);
    mesh.normals.assign(mesh.normals.size(), Vec3(1, 0, 0));
    EXPECT_TRUE(move_draw_mesh(draw, mesh).empty());  // shadows stay where they are
    EXPECT_EQ(moves(0), 2u);
    EXPECT_EQ(moves(1), 4u);
}

TEST(Mipmaps, are_means_of_light_down_to_one_texel) {
    // Checks of black and white, 6 x 2; then 3 x 1 and 1 x 1.
    Image8 image{6, 2, {}};
    for (int i = 0; i < 12; ++i) {
        const std::uint8_t value = (i + i / 6) % 2 ? 255 : 0;
        image.rgba.insert(image.rgba.end(), {value, value, value, value});
    }
    const std::vector<Image8> coded = mipmaps(image, true), plain = mipmaps(image, false);
    ASSERT_EQ(coded.size(), 2u);
    EXPECT_EQ(coded[0].width, 3);
    EXPECT_EQ(coded[0].height, 1);
    EXPECT_EQ(coded[1].rgba.size(), 4u);
    for (const Image8& level : coded)
        for (std::size_t i = 0; i < level.rgba.size(); ++i) EXPECT_EQ(level.rgba[i], i % 4 == 3 ? 128 : 188) << i;
    for (const Image8& level : plain)
        for (const std::uint8_t value : level.rgba) EXPECT_EQ(value, 128);
}

TEST(Mipmaps, odd_sides_lose_no_texel_and_one_colour_stays) {
    Image8 image{5, 1, std::vector<std::uint8_t>(20, 0)};
    image.rgba[16] = 240;  // the last one's red
    const std::vector<Image8> levels = mipmaps(image, false);
    ASSERT_EQ(levels.size(), 2u);
    EXPECT_EQ(levels[0].rgba[0], 0);
    EXPECT_EQ(levels[0].rgba[4], 80);
    EXPECT_EQ(levels[1].rgba[0], 40);
    for (int value = 0; value < 256; ++value)
        for (const bool srgb : {false, true})
            EXPECT_EQ(mipmaps({3, 3, std::vector<std::uint8_t>(36, std::uint8_t(value))}, srgb)[0].rgba,
                      std::vector<std::uint8_t>(4, std::uint8_t(value)));
}

TEST(Culling, keeps_what_may_be_seen_and_drops_what_is_outside) {
    const View view = look_at({0, 0, 0}, {0, 0, -1}, 1.0f);
    const Frustum frustum = daylit::frustum(projection(view, 100, 100) * view.view_from_world, true);
    const auto box = [](Vec3 center) {
        Bounds b;
        b.add(center - 0.5f);
        b.add(center + 0.5f);
        return b;
    };
    EXPECT_TRUE(may_see(frustum, box({0, 0, -5})));
    EXPECT_TRUE(may_see(frustum, box({0, 0, -50000})));  // no far plane
    EXPECT_TRUE(may_see(frustum, box({0, 0, 0})));       // around the eye
    EXPECT_FALSE(may_see(frustum, box({0, 0, 5})));
    EXPECT_FALSE(may_see(frustum, box({5, 0, -5})));
    EXPECT_FALSE(may_see(frustum, box({0, -4, -5})));
}

Bounds hall() {
    Bounds box;
    box.add({-40, 0, -30});
    box.add({40, 25, 30});
    return box;
}

TEST(SunShadow, cascades_hold_the_scene_and_stay_while_the_eye_hardly_moves) {
    const Sun sun{glm::normalize(Vec3(0.4f, 0.8f, 0.2f)), Rgb(90000)};
    const SunFit fit = fit_sun(sun, hall(), {1, 2, 3}, 2048);
    ASSERT_GE(fit.cascades.size(), 3u);
    const Mat4 whole = cascade_matrix(fit, fit.cascades.size() - 1, 2048);
    const Mat4 near = cascade_matrix(fit, 0, 2048);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p(corner & 1 ? 40 : -40, corner & 2 ? 25 : 0, corner & 4 ? 30 : -30);
        const Vec4 c = whole * Vec4(p, 1);
        EXPECT_LE(std::max(std::abs(c.x), std::abs(c.y)), 1.0f);
        EXPECT_GE(c.z, 0.0f);  // tall casters count in every cascade
        EXPECT_LE(c.z, 1.0f);
    }
    const Vec4 eye = near * Vec4(1, 2, 3, 1);
    EXPECT_LT(std::max(std::abs(eye.x), std::abs(eye.y)), 0.05f);

    // Snapped by whole texels: a step of a centimetre changes nothing or moves the map by 64 texels.
    int moved = 0;
    for (int i = 1; i <= 100; ++i) {
        const SunFit other = fit_sun(sun, hall(), {1.0f + 0.01f * float(i), 2, 3}, 2048);
        const Vec2 shift = (Vec2(other.cascades[0]) - Vec2(fit.cascades[0])) / fit.cascades[0].z;
        moved += other.cascades[0] != fit.cascades[0];
        EXPECT_NEAR(shift.x, 64.0f * std::round(shift.x / 64.0f), 0.01f);
        EXPECT_NEAR(shift.y, 64.0f * std::round(shift.y / 64.0f), 0.01f);
    }
    EXPECT_LT(moved, 100);
    EXPECT_GT(moved, 0);
}

// A roof 10 m above the ground shades |x|, |z| < 5 from a sun in the zenith; its penumbra is 2 * 10 m * tan(0.267 deg) wide.
TEST(SunReach, only_full_shadow_is_out_of_reach) {
    Bounds box;
    box.add({-10, 0, -10});
    box.add({10, 10, 10});
    constexpr int kTexels = 2048, kSide = kTexels / 4;
    const SunFit fit = fit_sun({{0, 1, 0}, Rgb(90000)}, box, {0, 2, 0}, kTexels);
    std::vector<FarthestDepth> maps;
    for (const Vec4& cascade : fit.cascades) {
        std::vector<float> farthest;
        const float block = 4.0f * cascade.z, half = 0.5f * block * kSide;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const Vec2 center = glm::abs(Vec2(cascade) + (Vec2(x, y) + 0.5f) * block - half);
                const float at = std::max(center.x, center.y) + 0.5f * block < 5.0f ? 10.0f : 0.0f;
                farthest.push_back((fit.block.direction.w - at) / fit.depth_range);
            }
        maps.emplace_back(kSide, std::move(farthest));
    }
    const auto reached = [&](const Vec3& center, float half, bool upwards = true, bool double_sided = false) {
        const Vec3 a = center + Vec3(-half, 0, half), b = center + Vec3(half, 0, half), c = center + Vec3(0, 0, -half);
        return may_reach(fit, maps, kTexels, upwards ? TriangleCorners{a, b, c} : TriangleCorners{a, c, b}, double_sided);
    };
    EXPECT_FALSE(reached({0, 0, 0}, 1.0f));
    EXPECT_FALSE(reached({4, 0, 0}, 0.5f));
    EXPECT_FALSE(reached({0, 0, 0}, 4.8f));  // across cascades
    EXPECT_TRUE(reached({0, 10, 0}, 1.0f));  // the roof itself
    EXPECT_TRUE(reached({0, 0, 0}, 6.0f));   // partly outside
    EXPECT_TRUE(reached({4.98f, 0, 0}, 0.01f));  // in the penumbra
    EXPECT_TRUE(reached({8, 0, 0}, 0.1f));
    EXPECT_FALSE(reached({8, 0, 0}, 0.1f, false));  // shows its back
    EXPECT_TRUE(reached({8, 0, 0}, 0.1f, false, true));
}

TEST(FramePlan, each_pass_says_why) {
    FrameFacts facts;
    facts.any_surface = true;
    facts.suns = 1;
    facts.sun_maps_stale = true;
    FramePlan plan = plan_frame(facts);
    for (const PassPlan& pass : plan) EXPECT_FALSE(pass.why.empty());
    EXPECT_TRUE(plan[std::size_t(PassKind::SunShadows)].runs);
    EXPECT_FALSE(plan[std::size_t(PassKind::LampShadows)].runs);
    EXPECT_FALSE(plan[std::size_t(PassKind::Relight)].runs);
    EXPECT_FALSE(plan[std::size_t(PassKind::Blended)].runs);
    facts.sun_maps_stale = false;
    EXPECT_FALSE(plan_frame(facts)[std::size_t(PassKind::SunShadows)].runs);
    facts.sun_maps_stale = true;
    facts.show = Layer::Albedo;
    plan = plan_frame(facts);
    EXPECT_FALSE(plan[std::size_t(PassKind::SunShadows)].runs);
    EXPECT_FALSE(plan[std::size_t(PassKind::Sky)].runs);
    EXPECT_TRUE(plan[std::size_t(PassKind::Surfaces)].runs);
}

}  // namespace
}  // namespace daylit
