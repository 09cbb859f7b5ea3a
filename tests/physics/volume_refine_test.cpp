// Where an octree's cells go, by light that is known at every place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gi/encode/volume_refine.h"
#include "scenes.h"

namespace daylit {
namespace {

using Field = std::function<float(const Vec3&)>;

float far_from_all(const Vec3&) {
    return 1e9f;
}

/// The same on all sides, at one hour, and without a word on how it changes.
SampleVolume sampled(const Field& field, const Field& nearness) {
    return [field, nearness](const Vec3& place, std::uint64_t) {
        VolumeSample sample;
        sample.nearness = nearness(place);
        sample.judged.assign(4 * kJudgedSides, 0.0f);
        std::fill_n(sample.judged.begin(), kJudgedSides, field(place));
        sample.light = SampleLight(sample.judged, 4);
        sample.noise.assign(kJudgedSides, 0.0f);
        return sample;
    };
}

/// A floor and a post, so that the box over them is a cube of eight roots along each side of a metre.
TestScene yard() {
    TestScene made;
    const std::uint32_t gray = made.add(lambert(Rgb(0.5f)));
    made.quad(gray, Vec3(0.0f), Vec3(0, 0, 8), Vec3(8, 0, 0));
    made.box(gray, Vec3(7.9f, 0, 7.9f), Vec3(8));
    return made;
}

RefinedVolume refined(TestScene& scene, const Field& field, const std::vector<Bounds>& regions, VolumeSettings settings,
                      const Field& nearness = far_from_all) {
    const RayScene& rays = scene.trace();
    FreeSpace space(rays);
    space.start_under_the_sky();
    space.spread();
    settings.error = 0.03f;
    return refine_volume(rays, space, regions, sampled(field, nearness), settings, StageProgress{Progress{}});
}

/// Of the leaf that holds a place.
int level_at(const Octree& octree, const Vec3& place) {
    for (const Octree::Node& node : octree.nodes) {
        const Vec3 from = octree.place(node.at), to = octree.place(node.at + node.units());
        if (node.leaf() && glm::all(glm::lessThanEqual(from, place)) && glm::all(glm::lessThan(place, to)))
            return node.level;
    }
    return -1;
}

/// A bump about a place, as high as this.
float bump(const Vec3& place, const Vec3& about, float high) {
    const Vec3 d = place - about;
    return high * std::exp(-4.0f * glm::dot(d, d));
}

const Vec3 kHere(2.5f, 3.5f, 2.5f), kThere(5.5f, 3.5f, 5.5f);

// Beside a lamp light is a thousand times what it is elsewhere, and so are errors: they must not take all cells.
TEST(VolumeRefine, WhatIsBrightDoesNotTakeAllCells) {
    TestScene scene = yard();
    const RefinedVolume found =
        refined(scene, [](const Vec3& p) { return 1.0f + bump(p, kHere, 3000.0f) + bump(p, kThere, 3.0f); }, {},
                {.max_level = 4, .most_cells = 512 + 7 * 80});
    EXPECT_TRUE(found.budget_spent);
    EXPECT_GE(level_at(found.octree, kThere), 1);
    EXPECT_LE(level_at(found.octree, kHere), level_at(found.octree, kThere));
}

// Of two places alike, the one that something moves through has the finer cells.
TEST(VolumeRefine, CellsGoWhereThingsMove) {
    TestScene scene = yard();
    const Bounds swept{kThere - 0.6f, kThere + 0.6f};
    const RefinedVolume found =
        refined(scene, [](const Vec3& p) { return 1.0f + bump(p, kHere, 1.0f) + bump(p, kThere, 1.0f); }, {swept},
                {.max_level = 4, .most_cells = 512 + 7 * 24});
    EXPECT_TRUE(found.budget_spent);
    EXPECT_GT(level_at(found.octree, kThere), level_at(found.octree, kHere));
}

// Of two places alike, the one that surfaces stand around, a room, has the finer cells.
TEST(VolumeRefine, CellsGoIndoors) {
    TestScene scene = yard();
    const RefinedVolume found = refined(
        scene, [](const Vec3& p) { return 1.0f + bump(p, kHere, 1.0f) + bump(p, kThere, 1.0f); }, {},
        {.max_level = 4, .most_cells = 512 + 7 * 24}, [](const Vec3& p) { return p.x > 4.0f ? 3.0f : 60.0f; });
    EXPECT_TRUE(found.budget_spent);
    EXPECT_GT(level_at(found.octree, kThere), level_at(found.octree, kHere));
}

// Light past the edge of something that stands in a cell may meet none of its faces' middles.
TEST(VolumeRefine, MiddlesOfEdgesTellBesideWhatStandsInACell) {
    TestScene scene = yard();
    scene.box(0, Vec3(3.9f, 3.9f, 3.9f), Vec3(4.1f));  // about the corner of eight cells
    const Vec3 edge(4.5f, 5.0f, 5.0f);                 // the middle of an edge of one of them, away from it
    const RefinedVolume found =
        refined(scene, [&](const Vec3& p) { return glm::distance(p, edge) < 0.1f ? 2.0f : 1.0f; }, {},
                {.max_level = 1, .most_cells = 100000});
    EXPECT_EQ(level_at(found.octree, Vec3(4.4f, 4.4f, 4.4f)), 1);
}

}  // namespace
}  // namespace daylit
