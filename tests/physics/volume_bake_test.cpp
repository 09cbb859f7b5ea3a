// The volume part of a bake against numbers derived on paper and against the reference.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "engine/base/random.h"
#include "gi/bake.h"
#include "gi/surface/swept_boxes.h"
#include "gi/transport/path_trace/path_trace.h"
#include "scenes.h"

namespace daylit {
namespace {

/// The quads of a TestScene as one node, and a small plate that moves, at `plate`.
Scene with_plate(const TestScene& standing_part, const Vec3& plate) {
    TestScene made;
    made.scene = standing_part.scene, made.mesh = standing_part.mesh;
    const std::size_t standing = made.mesh.triangle_count();
    made.quad(made.add(lambert(Rgb(0.5f))), plate, Vec3(0.1f, 0, 0), Vec3(0, 0.1f, 0));
    Scene scene = made.scene;
    for (int node = 0; node < 2; ++node) {
        Mesh mesh;
        const std::size_t first = node ? standing : 0, last = node ? made.mesh.triangle_count() : standing;
        for (std::size_t t = first; t < last; ++t) {
            Primitive p;
            p.material = int(made.mesh.materials[t]);
            p.indices = {0, 1, 2};
            for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
                p.positions.push_back(made.mesh.positions[made.mesh.indices[k]]);
                p.normals.push_back(made.mesh.normals[made.mesh.indices[k]]);
            }
            mesh.primitives.push_back(p);
        }
        scene.meshes.push_back(mesh);
        scene.order.push_back(int(scene.nodes.size()));
        scene.nodes.emplace_back();
        scene.nodes.back().mesh = node;
        scene.nodes.back().dynamic = node == 1;
    }
    return scene;
}

/// Walls of a closed box whose fronts look inwards.
TestScene room(const Material& floor, const Material& walls, const Material& side, const Vec3& size) {
    TestScene made;
    const std::uint32_t f = made.add(floor), w = made.add(walls), s = made.add(side);
    const Vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z), o(0.0f);
    made.quad(f, o, z, x);      // up
    made.quad(w, o + y, x, z);  // down
    made.quad(s, o, y, z);      // +x
    made.quad(w, o + x, z, y);  // -x
    made.quad(w, o, x, y);      // +z
    made.quad(w, o + z, y, x);  // -z
    return made;
}

BakeSettings one_hour() {
    BakeSettings settings;
    settings.light.sun = SunSource::None;
    settings.light.sky = SkySource::None;
    settings.error = 0.1;
    settings.from_hour = settings.to_hour = 12.0;
    return settings;
}

const std::vector<Vec3> kNormals = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1), glm::normalize(Vec3(-1, -2, 1))};

Rgb at(const Baked& baked, const Vec3& place, const Vec3& normal) {
    const std::vector<Rgb> weights = baked.volume->basis.weights(LightModel(baked.light, {}).scales(12.0, 0.0), 12.0);
    return VolumeLight(*baked.volume, weights).irradiance(place, normal);
}

// Every wall emits 50 and reflects half: radiance 100 from everywhere, E = pi 100.
TEST(VolumeBake, closed_furnace) {
    const Material wall = lambert(Rgb(0.5f), Rgb(50.0f));
    const Baked baked = bake(with_plate(room(wall, wall, wall, Vec3(4)), Vec3(2)), one_hour());
    ASSERT_TRUE(baked.volume);
    for (const Vec3& n : kNormals)
        for (const Vec3& p : {Vec3(2), Vec3(1.2f, 2.5f, 2.2f)})
            EXPECT_NEAR(at(baked, p, n).g, kPi * 100.0, 0.03 * kPi * 100.0);
}

// Nothing stands anywhere: the sky alone, E = pi L in every direction.
TEST(VolumeBake, under_a_constant_sky_alone) {
    BakeSettings settings = one_hour();
    settings.light.sky = SkySource::Constant;
    settings.light.sky_radiance = Rgb(1000.0f, 500.0f, 20.0f);
    const Baked baked = bake(with_plate(TestScene{}, Vec3(0)), settings);
    ASSERT_TRUE(baked.volume);
    EXPECT_FALSE(baked.lightmap);
    for (const Vec3& n : kNormals) {
        const Rgb e = at(baked, Vec3(0.2f), n);
        EXPECT_NEAR(e.r, kPi * 1000.0, 0.02 * kPi * 1000.0);
        EXPECT_NEAR(e.b, kPi * 20.0, 0.02 * kPi * 20.0);
    }
}

// A coloured room open above to a sky: mean within 3 %, RMS within 10 % of the mean.
TEST(VolumeBake, agrees_with_the_reference_at_free_points) {
    TestScene made = room(lambert(Rgb(0.6f)), lambert(Rgb(0.7f)), lambert(Rgb(0.7f, 0.1f, 0.1f)), Vec3(4));
    for (int corner = 0; corner < 6; ++corner) made.mesh.indices.pop_back();  // the wall at +z is missing
    made.mesh.materials.resize(made.mesh.materials.size() - 2);
    made.mesh.nodes.resize(made.mesh.materials.size());
    BakeSettings settings = one_hour();
    settings.light.sky = SkySource::Constant;
    settings.light.sky_radiance = Rgb(1000.0f);
    const Scene scene = with_plate(made, Vec3(2));
    const Baked baked = bake(scene, settings);
    ASSERT_TRUE(baked.volume && baked.lightmap);

    std::vector<SurfaceSample> points;
    for (int i = 0; i < 60; ++i) {
        Random random(5, std::uint64_t(i), 0);
        const Vec3 place = Vec3(1.2f) + 1.6f * Vec3(random.next(), random.next(), random.next());
        points.push_back({place, kNormals[std::size_t(i) % kNormals.size()]});
    }
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::Static);
    const RayScene rays(scene, mesh);
    const auto expected = path_trace_irradiance(rays, LightModel(baked.light, {}).at(12.0), {}, points,
                                                {.spp = 1024, .layer = Layer::Indirect});
    Rgb sum(0.0f), truth(0.0f);
    double square = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Rgb found = at(baked, points[i].position, points[i].normal);
        sum += found, truth += expected[i];
        square += std::pow(luminance(found) - luminance(expected[i]), 2.0);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / truth[c], 1.0, 0.03);
    const double mean = luminance(truth) / double(points.size());
    EXPECT_LT(std::sqrt(square / double(points.size())) / mean, 0.10);
}

// Straight light is the renderer's: a black room under the sun holds none.
TEST(VolumeBake, straight_sun_is_not_in_it) {
    TestScene made;
    made.quad(made.add(lambert(Rgb(0.0f))), Vec3(-5, 0, 5), Vec3(10, 0, 0), Vec3(0, 0, -10));
    BakeSettings settings = one_hour();
    settings.light.sun = SunSource::Given;
    settings.light.sun_direction = Vec3(0, 1, 0);
    settings.light.sun_illuminance = Rgb(100000.0f);
    const Baked black = bake(with_plate(made, Vec3(0, 1.5f, 0)), settings);
    EXPECT_EQ(at(black, Vec3(0, 1.5f, 0), Vec3(0, 1, 0)), Rgb(0.0f));
    // On a floor that reflects half, seen as pi / (pi + small rest) of the lower hemisphere: E from below is about 0.5
    // of the sun's 100000 lux times the floor's form factor, 0.9 at 1.5 m above a 10 m square.
    made.scene.materials[0] = lambert(Rgb(0.5f));
    const Baked gray = bake(with_plate(made, Vec3(0, 1.5f, 0)), settings);
    EXPECT_NEAR(at(gray, Vec3(0, 1.5f, 0), Vec3(0, -1, 0)).g, 0.5 * 100000.0 * 0.92, 0.08 * 50000.0);
}

TEST(VolumeBake, same_volume_for_any_number_of_threads) {
    const Material wall = lambert(Rgb(0.5f), Rgb(50.0f, 20.0f, 5.0f));
    const Scene scene = with_plate(room(wall, lambert(Rgb(0.8f)), wall, Vec3(3)), Vec3(1));
    BakeSettings settings = one_hour();
    settings.error = 1.0;
    const auto volume = [&](int threads) {
        IrradianceVolume result;
        tbb::task_arena(threads).execute([&] { result = *bake(scene, settings).volume; });
        return result;
    };
    const IrradianceVolume one = volume(1), three = volume(3);
    EXPECT_EQ(one.tree.nodes, three.tree.nodes);
    EXPECT_EQ(one.values, three.values);
    EXPECT_EQ(one.changes, three.changes);
    EXPECT_EQ(one.basis.curves, three.basis.curves);
}

TEST(VolumeBake, is_left_out_with_a_reason_where_nothing_moves) {
    Scene scene = with_plate(room(lambert(Rgb(0.5f)), lambert(Rgb(0.5f)), lambert(Rgb(0.5f)), Vec3(2)), Vec3(1));
    scene.nodes[1].dynamic = false;
    BakeSettings settings = one_hour();
    settings.error = 1.0;
    const Baked baked = bake(scene, settings);
    EXPECT_FALSE(baked.volume);
    for (const PlanItem& item : baked.plan) {
        if (item.part == "volume") {
            EXPECT_EQ(item.why, "no dynamic node");
        }
    }
}

TEST(SweptBoxes, follow_what_is_animated) {
    Scene scene = with_plate(TestScene{}, Vec3(0));
    Animation animation;
    animation.duration = 10.0f;
    animation.channels.push_back({1, AnimationPath::Translation, Interpolation::Linear, {0, 10}, {0, 0, 0, 20, 0, 0}});
    scene.animations.push_back(animation);
    Bounds all;
    for (const Bounds& box : swept_boxes(scene)) all.add(box.min), all.add(box.max);
    // From 1 m before the plate at x = 0 to 1 m behind it at nearly 20.
    EXPECT_LE(all.min.x, -1.0f);
    EXPECT_GT(all.min.x, -1.8f);
    EXPECT_GT(all.max.x, 20.4f);
}

}  // namespace
}  // namespace daylit
