// The scene's own TEXCOORD_1 as the lightmap's layout: where it lies, how fine it is, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "gi/surface/texels.h"

namespace daylit {
namespace {

/// A sheet of 2 x 1 metres of two triangles with TEXCOORD_1 at these places for its corners (0,0), (2,0), (2,1), (0,1).
Mesh sheet(const std::string& name, const std::array<Vec2, 4>& uvs) {
    Primitive p;
    p.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    p.normals.assign(4, Vec3(0, 0, 1));
    p.indices = {0, 1, 2, 0, 2, 3};
    p.uvs = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {uvs.begin(), uvs.end()}};
    Mesh mesh;
    mesh.name = name;
    mesh.primitives = {p};
    return mesh;
}

std::array<Vec2, 4> rectangle(float x0, float y0, float x1, float y1) {
    return {Vec2(x0, y0), Vec2(x1, y0), Vec2(x1, y1), Vec2(x0, y1)};
}

class KeptLayoutTest : public testing::Test {
  protected:
    void add(int mesh, const Vec3& at, const Vec3& scale = Vec3(1.0f)) {
        Node node;
        node.mesh = mesh;
        node.translation = at, node.scale = scale;
        scene_.order.push_back(int(scene_.nodes.size()));
        scene_.nodes.push_back(node);
    }
    void take(std::size_t budget) {
        scene_.materials.resize(1);
        mesh_ = world_mesh(scene_, pose_scene(scene_), Part::Static);
        kept_ = kept_layouts(scene_, mesh_);
        atlas_ = make_atlas(mesh_, budget, {}, kept_);
        texels_ = make_texels(mesh_, atlas_);
    }
    /// Every place finds a texel that lies there.
    void expect_texels_where_their_surface_is(float reach) {
        Random random(3, 0, 0);
        for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t)
            for (int i = 0; i < 20; ++i) {
                const float root = std::sqrt(random.next());
                const TexelPoint point{t, Vec2(root * random.next(), 0.0f)};
                const Vec3 place = position(mesh_, {t, {point.barycentric.x, root - point.barycentric.x}});
                const std::uint32_t texel = texels_.at(atlas_, t, {point.barycentric.x, root - point.barycentric.x});
                ASSERT_NE(texel, kNoTexel);
                EXPECT_LT(glm::distance(texels_.position[texel], place), reach) << "triangle " << t;
            }
    }
    std::string refusal() {
        try {
            take(1000);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    Scene scene_;
    WorldMesh mesh_;
    KeptLayouts kept_;
    Atlas atlas_;
    Texels texels_;
};

TEST_F(KeptLayoutTest, AnAtlasOfTheWholeSceneStaysAsItIsMirroredChartsToo) {
    scene_.meshes = {sheet("left", rectangle(0.0f, 0.0f, 0.5f, 0.5f)),
                     sheet("mirrored", rectangle(1.0f, 0.25f, 0.6f, 0.75f))};
    scene_.extras.lightmap = glm::ivec2(64, 32);
    add(0, Vec3(0)), add(1, Vec3(5, 0, 0));
    take(4000);
    EXPECT_EQ(kept_.layouts.size(), 1u);
    EXPECT_EQ(glm::ivec2(atlas_.width, atlas_.height), glm::ivec2(64, 32));
    const Vec2 half = (0.5f + 1.0f / 64.0f + 1e-3f) / Vec2(64, 32);  // and what keeps fetches inside
    for (std::size_t corner = 0; corner < mesh_.indices.size(); ++corner) {
        const Vec2 off = glm::abs(atlas_.corner_uvs[corner] - mesh_.uvs[mesh_.indices[corner]][1]);
        EXPECT_LE(off.x, half.x + 1e-6f);
        EXPECT_LE(off.y, half.y + 1e-6f);
    }
    expect_texels_where_their_surface_is(0.12f);  // texels are 6 cm wide
    ASSERT_EQ(atlas_.charts.size(), 2u);
    for (std::size_t t = 0; t < texels_.count(); ++t)  // the mirrored one's u grows the other way
        EXPECT_NEAR(texels_.along_u[t].x, texels_.chart[t] == 0 ? 1.0f : -1.0f, 1e-5f) << t;
}

TEST_F(KeptLayoutTest, CopiesOfAMeshGetRectanglesByTheirSizeInTheWorld) {
    scene_.meshes = {sheet("sheet", rectangle(0.1f, 0.1f, 0.3f, 0.9f))};
    add(0, Vec3(0)), add(0, Vec3(5, 0, 0), Vec3(2.0f)), add(0, Vec3(-5, 0, 0), Vec3(-1, 1, 1));
    take(12000);
    ASSERT_EQ(atlas_.charts.size(), 3u);
    std::set<std::pair<int, int>> taken;
    for (const PlacedChart& c : atlas_.charts) {
        EXPECT_NEAR(float(c.nx) / float(c.ny), 2.0f, 0.1f);  // as in the world, not as in TEXCOORD_1
        for (int y = 0; y < c.ny; ++y)
            for (int x = 0; x < c.nx; ++x) EXPECT_TRUE(taken.insert({c.x + x, c.y + y}).second);
    }
    const auto texels = [&](std::size_t i) { return float(atlas_.charts[i].nx * atlas_.charts[i].ny); };
    EXPECT_NEAR(texels(1) / texels(0), 4.0f, 0.3f);
    EXPECT_NEAR(texels(2) / texels(0), 1.0f, 0.1f);
    EXPECT_NEAR(texels(0) + texels(1) + texels(2), 12000.0f, 800.0f);
    expect_texels_where_their_surface_is(0.1f);
}

TEST_F(KeptLayoutTest, MeshesWithoutOneAreUnwrapped) {
    Mesh bare = sheet("bare", {});
    bare.primitives[0].uvs.resize(1);
    scene_.meshes = {sheet("sheet", rectangle(0, 0, 1, 1)), bare, sheet("a point", rectangle(0.5f, 0.5f, 0.5f, 0.5f))};
    add(0, Vec3(0)), add(1, Vec3(0, 2, 0)), add(2, Vec3(0, 4, 0));
    take(6000);
    EXPECT_EQ(atlas_.charts.size(), 3u);
    EXPECT_EQ(kept_.note,
              "TEXCOORD_1 of 1 meshes kept as one layout; 2 without it unwrapped (mesh 1 'bare' and others)");
    expect_texels_where_their_surface_is(0.1f);
}

TEST_F(KeptLayoutTest, WhatCannotBeKeptIsNamed) {
    scene_.meshes = {sheet("far", rectangle(0, 0, 1, 1e30f))};
    add(0, Vec3(0));
    EXPECT_NE(refusal().find("mesh 0 'far': has TEXCOORD_1 at ("), std::string::npos) << refusal();
    scene_.meshes = {sheet("folded", {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(1, 0.5f)})};
    EXPECT_NE(refusal().find("mesh 0 'folded': has a TEXCOORD_1 that covers the same place twice"), std::string::npos)
        << refusal();
    scene_.meshes = {sheet("flat", rectangle(0, 0, 1, 0))};
    EXPECT_NE(refusal().find("no static mesh of the scene has a TEXCOORD_1 with area"), std::string::npos) << refusal();
}

TEST(AtlasSize, MoreThanTheLargestTextureIsRefused) {
    WorldMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2};
    mesh.materials = mesh.nodes = {0};
    EXPECT_THROW(make_atlas(mesh, std::size_t(1) << 30), Error);
}

}  // namespace
}  // namespace daylit
