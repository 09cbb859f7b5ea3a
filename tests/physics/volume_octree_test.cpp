// The octree's interpolation, on fields known on paper.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.h"
#include "gi/encode/volume_modes.h"
#include "gi/encode/volume_octree.h"

namespace daylit {
namespace {

/// A smooth field with waves of about two units, and its change.
Vec4 waves(const Vec3& p) {
    const Vec3 k(2.1f, 2.9f, 1.7f), l(-1.3f, 0.8f, 2.3f);
    const float a = glm::dot(k, p) + 0.3f, b = glm::dot(l, p);
    return Vec4(std::sin(a) + 0.5f * std::cos(b), std::cos(a) * k - 0.5f * std::sin(b) * l);
}

Vec4 cubic(const Vec3& p) {
    const float x = p.x, y = p.y, z = p.z;
    return Vec4(1 + x - 2 * y + x * y * z + 0.5f * x * x * y - z * z * z + y * y, 1 + y * z + x * y,
                -2 + x * z + 0.5f * x * x + 2 * y, x * y - 3 * z * z);
}

Vec3 random_place(Random& random) {
    return Vec3(random.next(), random.next(), random.next());
}

/// RMS error over the unit cell's surroundings of a blend of exact corners, cells of this side.
double rms(VolumeBlend blend, float side) {
    Random random(7, 0, 0);
    double sum = 0.0;
    constexpr int kPlaces = 20000;
    for (int i = 0; i < kPlaces; ++i) {
        const Vec3 place = 4.0f * random_place(random), first = side * glm::floor(place / side);
        const std::array<Vec4, 8> weights = blend_weights(blend, (place - first) / side, side);
        float value = 0.0f;
        for (int c = 0; c < 8; ++c)
            value += glm::dot(weights[std::size_t(c)], waves(first + side * Vec3(c & 1, c >> 1 & 1, c >> 2)));
        sum += std::pow(double(value - waves(place).x), 2);
    }
    return std::sqrt(sum / kPlaces);
}

// Halving the cell divides the error by 2^order. Blending full extrapolations gains nothing over plain trilinear.
TEST(VolumeBlends, ConvergeWithTheirOrders) {
    for (const auto& [blend, order] :
         {std::pair(VolumeBlend::Trilinear, 2.0), std::pair(VolumeBlend::Oat, 2.0), std::pair(VolumeBlend::Annen, 2.0),
          std::pair(VolumeBlend::Half, 3.0), std::pair(VolumeBlend::Adini, 4.0)}) {
        const double coarse = rms(blend, 0.125f), fine = rms(blend, 0.0625f);
        EXPECT_NEAR(std::log2(coarse / fine), order, 0.3) << name(blend);
        std::printf("%-14s cells of 1/2 %.2g, 1/4 %.2g, 1/8 %.2g, 1/16 %.2g\n", name(blend), rms(blend, 0.5f),
                    rms(blend, 0.25f), coarse, fine);
    }
    EXPECT_LT(rms(VolumeBlend::Half, 0.125f), 0.1 * rms(VolumeBlend::Oat, 0.125f));
    EXPECT_LT(rms(VolumeBlend::Adini, 0.0625f), 0.5 * rms(VolumeBlend::Half, 0.0625f));
}

TEST(VolumeBlends, WeightsOfTheCellsOwnCornersAreOneAndZero) {
    for (const VolumeBlend blend : kVolumeBlends)
        for (int at = 0; at < 8; ++at) {
            const auto weights = blend_weights(blend, Vec3(at & 1, at >> 1 & 1, at >> 2), 2.0f);
            for (int c = 0; c < 8; ++c)
                EXPECT_NEAR(weights[std::size_t(c)][0], c == at ? 1.0f : 0.0f, 1e-6) << name(blend);
        }
}

TEST(VolumeBlends, TheChangeOfTheWeightsIsTheirDerivative) {
    Random random(3, 0, 0);
    constexpr float kSide = 2.0f, kStep = 1e-3f;
    for (int i = 0; i < 100; ++i) {
        const Vec3 t = 0.1f + 0.8f * random_place(random);
        for (int corner = 0; corner < 8; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 d(0.0f);
                d[axis] = kStep;
                const Vec4 expected = (glsl::volume_corner_weights(corner, t + d, kSide) -
                                       glsl::volume_corner_weights(corner, t - d, kSide)) /
                                      (2 * kStep * kSide);
                const Vec4 found = corner_weights_change(corner, t, kSide, axis);
                for (int part = 0; part < 4; ++part) EXPECT_NEAR(found[part], expected[part], 2e-4);
            }
    }
}

/// Leaves of up to five levels, sizes side by side as chance has it.
Octree random_octree(std::uint64_t seed) {
    Octree octree(Vec3(-1.0f, 2.0f, 0.5f), 2.0f, {2, 1, 2});
    Random random(seed, 0, 0);
    for (std::uint32_t n = 0; n < octree.nodes.size(); ++n)
        if (octree.nodes[n].level < 4 && random.next() < (octree.nodes[n].level == 0 ? 0.9f : 0.35f)) octree.split(n);
    return octree;
}

bool no_walls(const Lattice&, const LeafSide&, const LeafSide&) {
    return true;
}

std::vector<Vec4> records(const OctreeCells& made, const Octree& octree,
                          const std::function<Vec4(const Vec3&)>& field) {
    std::vector<Vec4> result(made.tree.records());
    for (std::size_t s = 0; s < made.samples.size(); ++s) result[s] = field(octree.place(made.samples[s].at));
    fill_hanging(made.tree, result, 1);
    return result;
}

float value_in(const VolumeTree& tree, std::uint32_t cell, const Vec3& t, const std::vector<Vec4>& records) {
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner)
        sum += glm::dot(glsl::volume_corner_weights(corner, t, tree.cells[cell].box.w),
                        records[record_of(tree.cells[cell], corner)]);
    return sum;
}

TEST(VolumeOctree, CubicsAreExactAcrossAllLevels) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Octree octree = random_octree(seed);
        const OctreeCells made = make_cells(octree, no_walls);
        ASSERT_GT(made.tree.hanging.size(), 100u);
        EXPECT_EQ(fault(made.tree), nullptr);
        const std::vector<Vec4> data = records(made, octree, cubic);
        Random random(seed, 1, 0);
        for (std::uint32_t c = 0; c < made.tree.cells.size(); ++c) {
            const Vec3 t = random_place(random);
            const Vec4& box = made.tree.cells[c].box;
            EXPECT_NEAR(value_in(made.tree, c, t, data), cubic(Vec3(box) + box.w * t).x, 2e-4);
        }
    }
}

// Whatever the data: noise in values and changes, and neighbours of any sizes.
TEST(VolumeOctree, NoFaceHasAJump) {
    double largest = 0.0;
    long pairs = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const Octree octree = random_octree(seed);
        const OctreeCells made = make_cells(octree, no_walls);
        Random random(seed, 2, 0);
        const std::vector<Vec4> data = records(made, octree, [&](const Vec3&) {
            return Vec4(1.0f + random.next(), 4.0f * random.next() - 2.0f, 4.0f * random.next() - 2.0f,
                        4.0f * random.next() - 2.0f);
        });
        const Vec3 end = octree.origin + octree.side * Vec3(octree.size[0], octree.size[1], octree.size[2]);
        for (int i = 0; i < 20000; ++i) {
            const auto c = std::uint32_t(random.next() * float(made.tree.cells.size()));
            const int axis = int(3.0f * random.next());
            const Vec4 box = made.tree.cells[c].box;
            Vec3 t = 0.001f + 0.998f * random_place(random);
            t[axis] = random.next() < 0.5f ? 0.0f : 1.0f;
            const Vec3 place = Vec3(box) + box.w * t;
            Vec3 outside = place;
            outside[axis] += (t[axis] == 0.0f ? -1e-3f : 1e-3f) * box.w;
            if (glm::any(glm::lessThan(outside, octree.origin)) || glm::any(glm::greaterThan(outside, end))) continue;
            const glsl::VolumeArrays arrays{made.tree.grid(), made.tree.nodes.data(), made.tree.cells.data(),
                                            made.tree.cuts.data(), data.data()};
            const std::uint32_t other = glsl::volume_place(arrays, outside).cell;
            ASSERT_NE(other, c);
            const Vec4 beside = made.tree.cells[other].box;
            const double here = value_in(made.tree, c, t, data);
            const double there = value_in(made.tree, other, (place - Vec3(beside)) / beside.w, data);
            largest = std::max(largest, std::abs(here - there) / std::max(std::abs(here), 1.0));
            ++pairs;
        }
    }
    std::printf("largest jump %.1e over %ld places on faces\n", largest, pairs);
    EXPECT_GT(pairs, 90000);
    EXPECT_LE(largest, 1e-4);
}

TEST(VolumeOctree, PlacesAreFoundInTheirCells) {
    const Octree octree = random_octree(2);
    const OctreeCells made = make_cells(octree, no_walls);
    const glsl::VolumeArrays arrays{made.tree.grid(), made.tree.nodes.data(), made.tree.cells.data(),
                                    made.tree.cuts.data(), nullptr};
    Random random(1, 0, 0);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 place = octree.origin - 1.0f + 6.0f * random_place(random);
        const glsl::VolumePlace found = glsl::volume_place(arrays, place);
        const Vec3 end = octree.origin + octree.side * Vec3(octree.size[0], octree.size[1], octree.size[2]);
        const Vec3 inside = glm::clamp(place, octree.origin, end);
        const Vec4 box = made.tree.cells[found.cell].box;
        for (int a = 0; a < 3; ++a) EXPECT_NEAR(box[a] + box.w * found.t[a], inside[a], 1e-5);
    }
    for (const float strange : {1e30f, -1e30f, std::nanf("")})
        EXPECT_LT(glsl::volume_place(arrays, Vec3(strange)).cell, made.tree.cells.size());
}

// A wall along x = 0.4 through one root of three: cells on its two sides share no record beside the wall.
TEST(VolumeOctree, AWallPartsItsSides) {
    Octree octree(Vec3(0.0f), 1.0f, {1, 1, 1});
    octree.nodes[0].cut = true;
    octree.nodes[0].plane = Vec4(1, 0, 0, -0.4f);
    const OctreeCells made =
        make_cells(octree, [](const Lattice&, const LeafSide& a, const LeafSide& b) { return a.side == b.side; });
    ASSERT_EQ(made.tree.cells.size(), 2u);
    EXPECT_EQ(made.tree.samples, 16u);
    std::vector<Vec4> data(16);
    for (std::size_t s = 0; s < 16; ++s) data[s] = Vec4(made.samples[s].seen_by[0].side == 0 ? 1000.0f : 1.0f, 0, 0, 0);
    const glsl::VolumeArrays arrays{made.tree.grid(), made.tree.nodes.data(), made.tree.cells.data(),
                                    made.tree.cuts.data(), data.data()};
    const auto value = [&](const Vec3& place) {
        const glsl::VolumePlace at = glsl::volume_place(arrays, place);
        return value_in(made.tree, at.cell, at.t, data);
    };
    EXPECT_NEAR(value(Vec3(0.41f, 0.5f, 0.5f)), 1000.0f, 1e-2);
    EXPECT_NEAR(value(Vec3(0.39f, 0.5f, 0.5f)), 1.0f, 1e-5);
}

TEST(VolumeOctree, WhatHasNoCellIsSentToTheNearest) {
    Octree octree(Vec3(0.0f), 1.0f, {3, 1, 1});
    octree.nodes[1].empty = octree.nodes[2].empty = true;
    const OctreeCells made = make_cells(octree, no_walls);
    ASSERT_EQ(made.tree.cells.size(), 1u);
    const glsl::VolumeArrays arrays{made.tree.grid(), made.tree.nodes.data(), made.tree.cells.data(),
                                    made.tree.cuts.data(), nullptr};
    const glsl::VolumePlace found = glsl::volume_place(arrays, Vec3(2.5f, 0.25f, 0.5f));
    EXPECT_EQ(found.cell, 0u);
    EXPECT_EQ(found.t, Vec3(1.0f, 0.25f, 0.5f));
}

// Broken trees are told apart before anything walks them.
TEST(VolumeOctree, FaultsAreFound) {
    const OctreeCells good = make_cells(random_octree(1), no_walls);
    const auto broken = [&](const auto& harm) {
        VolumeTree tree = good.tree;
        harm(tree);
        return fault(tree) != nullptr;
    };
    EXPECT_FALSE(broken([](VolumeTree&) {}));
    EXPECT_TRUE(broken([](VolumeTree& t) { t.cells.clear(); }));
    EXPECT_TRUE(broken([](VolumeTree& t) { t.nodes.resize(2); }));
    EXPECT_TRUE(broken([](VolumeTree& t) { t.nodes.back() = 0; }));
    EXPECT_TRUE(broken([](VolumeTree& t) { t.nodes.back() = glsl::kVolumeCell | std::uint32_t(t.cells.size()); }));
    EXPECT_TRUE(broken([](VolumeTree& t) { t.nodes.back() = glsl::kVolumeCut; }));
    EXPECT_TRUE(broken([](VolumeTree& t) { t.cells[3].box.w = 0.0f; }));
    EXPECT_TRUE(broken([](VolumeTree& t) { t.cells[3].high.y = std::uint32_t(t.records()); }));
    EXPECT_TRUE(broken([](VolumeTree& t) { t.hanging[0].cell[2] = std::uint32_t(t.cells.size()) - 1; }));
}

}  // namespace
}  // namespace daylit
