// The rule by which a moving thing is lit once, per vertex or per pixel.
#include "engine/baked/volume_mode.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "tests/support/volume_builder.h"

namespace daylit {
namespace {

/// A cube of this side around a place, its triangles' edges as long as given.
ThingSize cube(const Vec3& middle, float side, float edge) {
    ThingSize thing{{}, edge};
    thing.box.add(middle - 0.5f * side);
    thing.box.add(middle + 0.5f * side);
    return thing;
}

/// Cells of a metre, of which that at (3, 0, 0) is as small as `side`.
VolumeTree one_small_cell(float side) {
    VolumeTree tree = volume_of(Vec3(0.0f), {4, 1, 1}, [](int, int, int) { return 0.0f; }).tree;
    tree.cells[3].box.w = side;
    return tree;
}

TEST(VolumeMode, goes_by_the_size_against_the_local_cell) {
    const VolumeTree tree = one_small_cell(0.1f);
    EXPECT_EQ(volume_mode_of(cube(Vec3(0.5f), 0.25f, 0.1f), tree), VolumeMode::Object);
    EXPECT_EQ(volume_mode_of(cube(Vec3(0.5f), 0.26f, 0.1f), tree), VolumeMode::Vertex);
    EXPECT_EQ(volume_mode_of(cube(Vec3(0.5f), 0.26f, 0.26f), tree), VolumeMode::Pixel);
    // The same thing where cells are small, and where a corner alone reaches one.
    EXPECT_EQ(volume_mode_of(cube(Vec3(3.5f, 0.5f, 0.5f), 0.25f, 0.02f), tree), VolumeMode::Vertex);
    EXPECT_EQ(volume_mode_of(cube(Vec3(2.9f, 0.5f, 0.5f), 0.25f, 0.1f), tree), VolumeMode::Pixel);
    // Beside the volume the nearest cell is the local one.
    EXPECT_EQ(volume_mode_of(cube(Vec3(-9.0f), 0.2f, 0.1f), tree), VolumeMode::Object);
}

TEST(VolumeMode, names_go_there_and_back) {
    for (const VolumeMode mode : {VolumeMode::Auto, VolumeMode::Object, VolumeMode::Vertex, VolumeMode::Pixel})
        EXPECT_EQ(parse_volume_mode(name(mode)), mode);
    EXPECT_THROW(parse_volume_mode("texel"), UsageError);
}

}  // namespace
}  // namespace daylit
