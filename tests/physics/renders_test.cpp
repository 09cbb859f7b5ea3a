// The reference against an independent path tracer's pictures (../shared/reference/renders; its README has the units).
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/scene/gltf.h"
#include "tests/physics/scenes.h"

namespace daylit {
namespace {

struct Render {
    std::string picture, scene;
    Vec3 eye, at;
    float fov_degrees;
    Vec3 sun;
    bool sun_only;
    int spp;
};

/// Means over tiles, so that what the two pictures' noise has in common with no structure averages out.
std::vector<glm::dvec3> tile_means(const Image& image, int tile) {
    std::vector<glm::dvec3> means;
    for (int y0 = 0; y0 + tile <= image.height; y0 += tile)
        for (int x0 = 0; x0 + tile <= image.width; x0 += tile) {
            glm::dvec3 sum(0.0);
            for (int y = y0; y < y0 + tile; ++y)
                for (int x = x0; x < x0 + tile; ++x) sum += glm::dvec3(image.at(x, y));
            means.push_back(sum / double(tile * tile));
        }
    return means;
}

void expect_agreement(const Render& render) {
    const std::filesystem::path shared = DAYLIT_SHARED_DIR;
    const std::filesystem::path picture = shared / "reference/renders" / (render.picture + ".exr");
    const std::filesystem::path scene_path = shared / "scenes" / render.scene;
    for (const auto& path : {picture, scene_path})
        if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
    const Image theirs = read_image(picture);
    const Scene scene = load_scene(scene_path, {.lambert = true});
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::All);
    const RayScene rays(scene, mesh);
    Lighting lighting = one_sun(render.sun, Rgb(90000.0f));
    if (!render.sun_only) lighting.sky = constant_sky(Rgb(4000.0f)).sky;
    const View view = look_at(render.eye, render.at, float(render.fov_degrees * kDegree));
    const PathTraceImage ours =
        path_trace(rays, lighting, {}, view, theirs.width, theirs.height,
                   {.spp = render.spp, .max_bounces = 13, .layer = render.sun_only ? Layer::Direct : Layer::Final});

    const Rgb a = mean(ours.radiance), b = mean(theirs);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c] / b[c], 1.0, 0.01) << "channel " << c;
    const std::vector<glm::dvec3> our_tiles = tile_means(ours.radiance, 20), their_tiles = tile_means(theirs, 20);
    double squares = 0.0;
    for (std::size_t i = 0; i < our_tiles.size(); ++i)
        squares += std::pow(glm::length(our_tiles[i] - their_tiles[i]) / glm::length(glm::dvec3(b)), 2.0);
    // The noise of a tile's mean: the picture's per-pixel error over the square root of its 400 pixels.
    const double noise = ours.relative_error / 20.0;
    EXPECT_LT(std::sqrt(squares / double(our_tiles.size())), 0.01 + 2.0 * noise);
}

const Vec3 kDuplexEye(3.2f, 1.5f, 13.2f), kDuplexAt(5.2f, 1.0f, 19.8f), kDuplexSun(0.2f, 0.6f, 0.77f);
const Vec3 kRoomEye(0, 0.5f, 11), kRoomAt(0, 0, 0), kRoomSun(0.3f, 0.6f, 0.74f);
const char* const kDuplex = "duplex-apartment/duplex-apartment.gltf";
const char* const kRoom = "living-room/living_room.glb";

TEST(IndependentRenders, DuplexFinal) {
    expect_agreement({"duplex-final", kDuplex, kDuplexEye, kDuplexAt, 60, kDuplexSun, false, 32});
}
TEST(IndependentRenders, DuplexSunDirect) {
    expect_agreement({"duplex-sun-direct", kDuplex, kDuplexEye, kDuplexAt, 60, kDuplexSun, true, 32});
}
TEST(IndependentRenders, LivingRoomFinal) {
    expect_agreement({"living-room-final", kRoom, kRoomEye, kRoomAt, 50, kRoomSun, false, 16});
}
TEST(IndependentRenders, LivingRoomSunDirect) {
    expect_agreement({"living-room-sun-direct", kRoom, kRoomEye, kRoomAt, 50, kRoomSun, true, 16});
}

}  // namespace
}  // namespace daylit
