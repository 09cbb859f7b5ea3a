// The whole bake against numbers derived on paper and against the reference.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "content/content.h"
#include "engine/base/file.h"
#include "engine/scene/gltf.h"
#include "engine/scene/tangents.h"
#include "engine/scene/texture.h"
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
    SurfaceSample place;  // its normal is the leaned one
    Rgb irradiance;
    Rgb flat;  // on the surface itself
};

/// A direction in which the atlas coordinate u grows on a triangle.
Vec3 growth_of_u(const std::array<Vec3, 3>& p, std::span<const Vec2> uv) {
    const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
    return ((p[1] - p[0]) * b.y - (p[2] - p[0]) * a.y) * (a.x * b.y - b.x * a.y > 0.0f ? 1.0f : -1.0f);
}

/// The lightmap at points spread over the static triangles for which `wanted` holds.
/// lean   degrees by which normals lean, to another side at each point
template <class Wanted>
std::vector<Lookup> look_up(const Scene& scene, const Baked& baked, double hour, const Wanted& wanted,
                            float lean = 0.0f) {
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
            const std::span<const Vec2> uvs = std::span(baked.lightmap->corner_uvs).subspan(3 * t, 3);
            const Vec2 uv = w.x * uvs[0] + w.y * uvs[1] + w.z * uvs[2];
            const Vec3 u = glm::normalize(growth_of_u(p, uvs)), v = glm::cross(n, u);
            const float turn = float(found.size()), slope = std::sin(glm::radians(lean));
            const Vec3 leaned(slope * std::cos(turn), slope * std::sin(turn), std::cos(glm::radians(lean)));
            found.push_back({{place, leaned.x * u + leaned.y * v + leaned.z * n},
                             baked.lightmap->irradiance(uv, leaned, light),
                             baked.lightmap->irradiance(uv, light)});
        }
    }
    return found;
}

/// The truth there, at noon.
std::vector<Rgb> traced(const Scene& scene, const Baked& baked, std::span<const Lookup> found) {
    const Pose pose = pose_scene(scene);
    const WorldMesh mesh = world_mesh(scene, pose, Part::All);
    const RayScene rays(scene, mesh);
    const std::vector<PlacedLight> lamps = placed_lights(scene, pose);
    std::vector<SurfaceSample> points;
    for (const Lookup& l : found) points.push_back(l.place);
    return path_trace_irradiance(rays, LightModel(baked.light, lamps).at(12.0), lamps, points,
                                 {.spp = 512, .layer = Layer::Indirect});
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

TEST_F(Bake, SealedRoomStaysBlackAtEveryHour) {
    const Scene scene = made("sealed_room");
    BakeSettings settings = quick(0.0);
    settings.to_hour = 24.0, settings.every_hours = 2.0;
    const Baked baked = bake(scene, settings);
    for (double hour = 0.0; hour < 24.0; hour += 0.5) {
        const auto inside = look_up(scene, baked, hour, [](const Vec3& p, const Vec3&) {
            return std::abs(p.x) < 2.05f && std::abs(p.z) < 2.05f && p.y > -0.05f && p.y < 2.65f;
        });
        ASSERT_GE(inside.size(), 40u);
        for (const Lookup& l : inside) ASSERT_EQ(l.irradiance, Rgb(0.0f)) << hour << ": " << l.place.position.y;
        const auto outside =
            look_up(scene, baked, hour, [](const Vec3& p, const Vec3& n) { return n.y > 0.9f && p.y > 2.7f; });
        ASSERT_FALSE(outside.empty());
        for (const Lookup& l : outside) EXPECT_GT(l.irradiance.g, hour > 6.0 && hour < 21.0 ? 1000.0f : 0.0f) << hour;
    }
}

TEST_F(Bake, NoLightComesThroughAWallThinnerThanATexel) {
    const Scene scene = made("thin_wall");  // of 2 cm; the lamp is on its left
    const Baked baked = bake(scene, quick(22.0));
    const auto mean_of = [&](float from, float to) {
        const auto found = look_up(scene, baked, 22.0, [&](const Vec3& p, const Vec3&) {
            return p.x > from && p.x < to && p.y > -0.05f && p.y < 2.65f && std::abs(p.z) < 2.05f;
        });
        EXPECT_GE(found.size(), 20u);
        double sum = 0.0;
        for (const Lookup& l : found) sum += luminance(l.irradiance) / double(found.size());
        return sum;
    };
    EXPECT_GT(mean_of(-3.05f, -0.005f), 10.0);
    EXPECT_EQ(mean_of(0.005f, 3.05f), 0.0);
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

    const std::vector<Rgb> expected = traced(scene, baked, found);
    double sum = 0.0, truth = 0.0, square = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double error = luminance(found[i].irradiance) - luminance(expected[i]);
        sum += luminance(found[i].irradiance), truth += luminance(expected[i]), square += error * error;
    }
    EXPECT_NEAR(sum / truth, 1.0, 0.04);
    EXPECT_LT(std::sqrt(square / double(found.size())) / (truth / double(found.size())), 0.12);
}

/// All normals leaned by 20 degrees, another way at each place: what the lightmap says of normal maps, and the truth.
TEST_F(Bake, LeanedNormalsAgreeWithTheReference) {
    Scene scene = made("two_rooms");
    scene.images.push_back({1, 1, {128, 128, 255, 255}}), scene.image_names.push_back("flat normals");
    scene.textures.push_back({.image = int(scene.images.size() - 1)});
    for (Material& m : scene.materials) m.normal_texture.texture = int(scene.textures.size() - 1);
    const Baked baked = bake(scene, quick(12.0, 0.1));
    ASSERT_TRUE(baked.lightmap->tilted());
    const std::vector<Lookup> found = look_up(
        scene, baked, 12.0,
        [](const Vec3& p, const Vec3&) {
            return p.x > -4.15f && p.x < -0.05f && std::abs(p.z) < 2.05f && p.y > -0.05f && p.y < 2.85f;
        },
        20.0f);
    const std::vector<Rgb> expected = traced(scene, baked, found);
    double leaned_error = 0.0, flat_error = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double truth = luminance(expected[i]), share = 1.0 / (truth * double(found.size()));
        leaned_error += share * std::abs(luminance(found[i].irradiance) - truth);
        flat_error += share * std::abs(luminance(found[i].flat) - truth);
    }
    EXPECT_LT(leaned_error, 0.09);
    EXPECT_LT(leaned_error, 0.75 * flat_error);  // against the surface's own normal
}

// Facets that lean by 40 degrees, to four sides in turn: of a lamp's light they reflect the mean cosine's share, of
// light from all around half as much is missing.
TEST_F(Bake, BumpsReflectLessThanTheSurfaceThatTheyAreOn) {
    Scene scene = made("two_rooms");
    const auto facet = [](double side) { return std::uint8_t(std::lround(127.5 + 127.5 * std::sin(side))); };
    const double lean = glm::radians(40.0);
    const std::uint8_t low = facet(-lean), high = facet(lean), up = facet(0.5 * kPi - lean);
    scene.images.push_back({2, 2, {low, 128, up, 255, 128, low, up, 255, 128, high, up, 255, high, 128, up, 255}});
    scene.image_names.push_back("facets");
    scene.textures.push_back({.image = int(scene.images.size() - 1), .filter = Filter::Nearest});
    for (Material& m : scene.materials) {
        m.normal_texture.texture = int(scene.textures.size() - 1);
        m.normal_texture.transform = {16.0f, 0.0f, 0.0f, 0.0f, 16.0f, 0.0f};
    }
    for (Mesh& mesh : scene.meshes)
        for (Primitive& primitive : mesh.primitives) {
            primitive.uvs.resize(1);
            for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
                const Vec3 &p = primitive.positions[v], n = glm::abs(primitive.normals[v]);
                primitive.uvs[0].push_back(n.x > 0.5f ? Vec2(p.y, p.z) : n.y > 0.5f ? Vec2(p.z, p.x) : Vec2(p.x, p.y));
            }
            make_tangents(primitive, 0);
        }
    EXPECT_NEAR(mean_cosine(scene, scene.materials[0]), std::cos(lean), 0.005);
    const Baked baked = bake(scene, quick(12.0, 0.1));
    const auto found = look_up(scene, baked, 12.0, [](const Vec3& p, const Vec3&) {
        return p.x > -4.15f && p.x < -0.05f && std::abs(p.z) < 2.05f && p.y > -0.05f && p.y < 2.85f;
    });
    const std::vector<Rgb> expected = traced(scene, baked, found);
    double sum = 0.0, truth = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
        sum += luminance(found[i].irradiance), truth += luminance(expected[i]);
    EXPECT_NEAR(sum / truth, 1.0, 0.05);
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
