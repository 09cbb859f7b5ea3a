// What the records of a volume make of samples that were taken beside an opening.
#include <gtest/gtest.h>

#include <algorithm>

#include "gi/encode/volume_fit.h"

namespace daylit {
namespace {

constexpr float kSide = 4.0f;

/// Two numbers, red and green; all sides see the red.
VolumeSample sample_of(const Vec2& value, const Vec2& change_along_z, float nearness) {
    VolumeSample sample;
    const std::array<float, 8> light = {value.r, value.g, 0.0f, 0.0f, 0.0f, 0.0f, change_along_z.r, change_along_z.g};
    sample.light = SampleLight(light, 4);
    sample.judged.assign(4 * kJudgedSides, 0.0f);
    for (std::size_t side = 0; side < kJudgedSides; ++side) {
        sample.judged[side] = value.r;
        sample.judged[3 * kJudgedSides + side] = change_along_z.r;
    }
    sample.noise.assign(kJudgedSides, 0.0f);
    sample.nearness = nearness;
    return sample;
}

/// One cell of which the face at z = 0 lies in a wall, but for its middle, which is an opening. Light in the cell is
/// even; close to the wall it changes over a hand's breadth, red more than green.
RefinedVolume cell_before_a_wall(const Vec2& light, const Vec2& change) {
    RefinedVolume volume;
    volume.octree = Octree(Vec3(0.0f), kSide, {1, 1, 1});
    RefinedLeaf leaf;
    const auto add = [&](const VolumeSample& sample) {
        volume.places.samples.push_back(sample);
        return int(volume.places.samples.size()) - 1;
    };
    for (int p = 0; p < kLeafPlaces; ++p) {
        const Lattice at(p % 3, p / 3 % 3, p / 9);
        const bool free = at.z > 0 || at == Lattice(1, 1, 0);
        const int taken = free ? add(sample_of(light, Vec2(0.0f), kSide)) : -1;
        volume.places.places.push_back({kOctreeUnits / 2 * at, free, taken});
        leaf.place[std::size_t(p)] = std::uint32_t(p);
        leaf.side[std::size_t(p)] = free ? 0 : -1;
        if (free || at.x == 1 || at.y == 1) continue;
        const Vec3 before(0.5f * float(at.x), 0.5f * float(at.y), 0.2f);
        leaf.before_walls.push_back({before, p, 0, add(sample_of(light, change, 0.18f * kSide))});
    }
    volume.leaves[0] = leaf;
    return volume;
}

TEST(VolumeFit, ASteepChangeBesideAWallSwingsNeitherLightNorHue) {
    const Vec2 light(500.0f, 400.0f);
    const RefinedVolume refined = cell_before_a_wall(light, Vec2(-6.0f, -2.0f) * light);
    const OctreeCells cells =
        make_cells(refined.octree, [](const Lattice&, const LeafSide&, const LeafSide&) { return true; });
    const VolumeFit fit = fit_volume(cells, refined, 2, VolumeBlend::Adini);
    const glsl::VolumeCell& cell = cells.tree.cells[0];
    for (int i = 0; i < 9 * 9 * 9; ++i) {
        const Vec3 t = Vec3(i % 9, i / 9 % 9, i / 81) / 8.0f;
        const std::array<Vec4, 8> weights = blend_weights(VolumeBlend::Adini, t, cell.box.w);
        Vec2 found(0.0f);
        for (int corner = 0; corner < 8; ++corner)
            for (int part = 0; part < 4; ++part)
                for (int c = 0; c < 2; ++c)
                    found[c] += weights[std::size_t(corner)][part] *
                                fit.records[std::size_t(8 * record_of(cell, corner) + 2 * std::uint32_t(part)) +
                                            std::size_t(c)];
        const Vec2 ratio = found / light;
        for (int c = 0; c < 2; ++c) {
            EXPECT_GT(ratio[c], 1.0f / 1.5f) << c << " at " << t.x << " " << t.y << " " << t.z;
            EXPECT_LT(ratio[c], 1.5f) << c << " at " << t.x << " " << t.y << " " << t.z;
        }
        EXPECT_NEAR(ratio.r / ratio.g, 1.0f, 0.2f) << t.x << " " << t.y << " " << t.z;
    }
}

}  // namespace
}  // namespace daylit
