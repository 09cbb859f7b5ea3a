// Which places count as free.
#include <gtest/gtest.h>

#include "gi/surface/free_space.h"
#include "scenes.h"

namespace daylit {
namespace {

// Cells at the level's rim have their corners on the border of its box.
TEST(FreeSpace, TheBorderOfTheBoxIsOpen) {
    TestScene scene;
    const std::uint32_t gray = scene.add(lambert(Rgb(0.5f)));
    scene.quad(gray, Vec3(0.0f), Vec3(0, 0, 8), Vec3(8, 0, 0));
    scene.box(gray, Vec3(7.9f, 0, 7.9f), Vec3(8));
    const RayScene& rays = scene.trace();
    FreeSpace space(rays);
    space.start_under_the_sky();
    space.spread();
    for (const float beside : {0.0f, 8.0f}) {
        EXPECT_TRUE(space.reachable(Vec3(beside, 4, 3))) << beside;
        EXPECT_TRUE(space.reachable(Vec3(3, 4, beside))) << beside;
    }
    EXPECT_TRUE(space.reachable(Vec3(4, 8, 4)));
    EXPECT_FALSE(space.reachable(Vec3(4, 8.1f, 4)));
    EXPECT_FALSE(space.reachable(Vec3(4, 0, 4)));
}

}  // namespace
}  // namespace daylit
