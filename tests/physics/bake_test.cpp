// The whole bake against numbers derived on paper and against the reference.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "content/content.h"
#include "engine/base/file.h"
#include "engine/scene/gltf.h"
#include "gi/bake.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {
namespace {

namespace fs = std::filesystem;

class Bake : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("daylit_bake_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    Scene made(const std::string& name) {
        make_scene(name, folder_ / (name + ".glb"));
        return load_scene(folder_ / (name + ".glb"));
    }
    fs::path folder_;
};

/// A few seconds' bake of one hour.
BakeSettings quick(double hour, double error = 0.3) {
    BakeSettings settings;
    settings.error = error;
    settings.from_hour = settings.to_hour = hour;
    return settings;
}

struct Lookup {
    SurfaceSample place;
    Rgb irradiance;
};

/// The lightmap at points spread over the static triangles for which `wanted` holds.
template <class Wanted>
std::vector<Lookup> look_up(const Scene& scene, const Baked& baked, double hour, const Wanted& wanted) {
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::Static);
    const LightScales scales = LightModel(baked.light, placed_lights(scene, pose_scene(scene))).at(hour).scales;
    const std::vector<Rgb> light = baked.lightmap->tile_light(baked.lightmap->basis.weights(scales, hour));
    std::vector<Lookup> found;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.positions[mesh.indices[3 * t + k]];
        const Vec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
        for (const Vec3& w : {Vec3(1 / 3.f), Vec3(0.7f, 0.2f, 0.1f), Vec3(0.1f, 0.6f, 0.3f), Vec3(0.2f, 0.1f, 0.7f)}) {
            const Vec3 place = w.x * p[0] + w.y * p[1] + w.z * p[2];
            if (!wanted(place, n)) continue;
            const Vec2 uv = w.x * baked.lightmap->corner_uvs[3 * t] + w.y * baked.lightmap->corner_uvs[3 * t + 1] +
                            w.z * baked.lightmap->corner_uvs[3 * t + 2];
            found.push_back({{place, n}, baked.lightmap->irradiance(uv, light)});
        }
    }
    return found;
}

bool anywhere(const Vec3&, const Vec3&) {
    return true;
}

// Every wall emits Le = 50 and reflects rho = 0.5: L = Le / (1 - rho) everywhere, and E = pi L.
TEST_F(Bake, ClosedFurnace) {
    const Scene scene = made("furnace");
    const auto found = look_up(scene, bake(scene, quick(12.0)), 12.0, anywhere);
    ASSERT_GE(found.size(), 40u);
    const double expected = kPi * 50.0 / (1.0 - 0.5);
    for (const Lookup& l : found) EXPECT_NEAR(l.irradiance.g, expected, 0.02 * expected);
}

TEST_F(Bake, SealedRoomStaysBlackUnderTheNoonSun) {
    const Scene scene = made("sealed_room");
    const Baked baked = bake(scene, quick(12.0));
    const auto inside = look_up(scene, baked, 12.0, [](const Vec3& p, const Vec3&) {
        return std::abs(p.x) < 2.05f && std::abs(p.z) < 2.05f && p.y > -0.05f && p.y < 2.65f;
    });
    const auto outside = look_up(scene, baked, 12.0, [](const Vec3& p, const Vec3& n) { return n.y > 0.9f && p.y > 2.7f; });
    ASSERT_GE(inside.size(), 40u);
    ASSERT_FALSE(outside.empty());
    for (const Lookup& l : inside) EXPECT_EQ(l.irradiance, Rgb(0.0f)) << l.place.position.x << " " << l.place.position.y;
    for (const Lookup& l : outside) EXPECT_GT(l.irradiance.g, 1000.0f);
}

TEST_F(Bake, LightDoesNotLeakThroughTheWallOfTwoRooms) {
    const Scene scene = made("two_rooms");
    const auto dark = look_up(scene, bake(scene, quick(12.0)), 12.0, [](const Vec3& p, const Vec3&) {
        return p.x > 0.2f && p.x < 4.2f && std::abs(p.z) < 2.05f && p.y > -0.05f && p.y < 2.85f;
    });
    ASSERT_GE(dark.size(), 40u);
    for (const Lookup& l : dark) EXPECT_EQ(l.irradiance, Rgb(0.0f)) << l.place.position.x << " " << l.place.position.y;
}

TEST_F(Bake, AgreesWithTheReferenceInTheLitRoom) {
    const Scene scene = made("two_rooms");
    const Baked baked = bake(scene, quick(12.0, 0.1));
    const auto found = look_up(scene, baked, 12.0, [](const Vec3& p, const Vec3&) {
        return p.x > -4.15f && p.x < -0.05f && std::abs(p.z) < 2.05f && p.y > -0.05f && p.y < 2.85f;
    });
    ASSERT_GE(found.size(), 40u);

    const Pose pose = pose_scene(scene);
    const WorldMesh mesh = world_mesh(scene, pose, Part::All);
    const RayScene rays(scene, mesh);
    const std::vector<PlacedLight> lamps = placed_lights(scene, pose);
    std::vector<SurfaceSample> points;
    for (const Lookup& l : found) points.push_back(l.place);
    const auto expected = path_trace_irradiance(rays, LightModel(baked.light, lamps).at(12.0), lamps, points,
                                                {.spp = 512, .layer = Layer::Indirect});
    double sum = 0.0, truth = 0.0, square = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double error = luminance(found[i].irradiance) - luminance(expected[i]);
        sum += luminance(found[i].irradiance), truth += luminance(expected[i]), square += error * error;
    }
    EXPECT_NEAR(sum / truth, 1.0, 0.04);
    EXPECT_LT(std::sqrt(square / double(found.size())) / (truth / double(found.size())), 0.12);
}

TEST_F(Bake, LampsOfTheEveningShineInTheEveningOnly) {
    Scene scene = made("thin_wall");  // one lamp on one side of a wall; no sun or sky comes in
    ASSERT_EQ(scene.lights.size(), 1u);
    scene.lights[0].lit = Lit::Evening;
    BakeSettings settings = quick(12.0);
    settings.to_hour = 23.0, settings.every_hours = 11.0;
    const Baked baked = bake(scene, settings);
    scene.lights[0].lit = Lit::Always;
    const Baked always = bake(scene, settings);
    const auto mean_at = [&](const Baked& from, double hour) {
        double sum = 0.0;
        for (const Lookup& l : look_up(scene, from, hour, [](const Vec3&p, const Vec3&) {
                 return p.x > -3.05f && p.x < -0.005f && p.y > -0.05f && p.y < 2.65f && std::abs(p.z) < 2.05f;
             }))
            sum += luminance(l.irradiance);
        return sum;
    };
    EXPECT_LT(mean_at(baked, 12.0), 0.01 * mean_at(always, 12.0));
    EXPECT_NEAR(mean_at(baked, 23.0) / mean_at(always, 23.0), 1.0, 0.02);
}

TEST_F(Bake, SameBytesForAnyNumberOfThreads) {
    const Scene scene = made("two_rooms");
    BakeSettings settings = quick(11.0, 1.0);
    settings.to_hour = 13.0;
    const auto bytes = [&](int threads) {
        tbb::task_arena(threads).execute([&] { write_baked(folder_ / "bake.daylit", bake(scene, settings)); });
        return read_file(folder_ / "bake.daylit");
    };
    const auto one = bytes(1);
    EXPECT_EQ(one, bytes(3));
    settings.seed = 2;
    EXPECT_NE(one, bytes(1));
}

TEST_F(Bake, StopsWhenAsked) {
    const Scene scene = made("furnace");
    EXPECT_THROW(bake(scene, quick(12.0), [](double done) { return done < 0.1; }), Interrupted);
}

// A bake that is stopped, or killed in the middle of a write, and resumed gives the bytes of one that was left alone.
TEST_F(Bake, ResumesToTheSameBytes) {
    const Scene scene = made("two_rooms");
    BakeSettings settings = quick(12.0, 0.5);
    const auto bytes = [&](const BakeSettings& how) {
        write_baked(folder_ / "bake.daylit", bake(scene, how));
        return read_file(folder_ / "bake.daylit");
    };
    const auto alone = bytes(settings);
    settings.checkpoint = folder_ / "bake.part";
    EXPECT_THROW(bake(scene, settings, [](double done) { return done < 0.45; }), Interrupted);
    const auto kept = read_file(settings.checkpoint);
    ASSERT_GT(kept.size(), 100000u);
    settings.resume = true;
    double first = 1.0;  // progress at the first look after the start
    const Progress watch = [&](double done) {
        if (done > 0.02) first = std::min(first, done);
        return true;
    };
    write_baked(folder_ / "bake.daylit", bake(scene, settings, watch));
    EXPECT_EQ(read_file(folder_ / "bake.daylit"), alone);
    EXPECT_GT(first, 0.1);  // what was kept was not traced again

    write_file(settings.checkpoint, std::span(kept).first(kept.size() - 1000));
    EXPECT_EQ(bytes(settings), alone);
    auto damaged = kept;
    damaged[kept.size() / 2] ^= 1;
    write_file(settings.checkpoint, damaged);
    EXPECT_EQ(bytes(settings), alone);
    settings.seed = 2;  // another bake: nothing of this one's is taken
    settings.resume = true;
    EXPECT_NE(bytes(settings), alone);
}

TEST_F(Bake, RefusesPartsThatItCannotBake) {
    BakeSettings settings = quick(12.0);
    settings.parts = {"dirmap"};
    EXPECT_THROW(bake(made("furnace"), settings), std::runtime_error);
}

}  // namespace
}  // namespace daylit
