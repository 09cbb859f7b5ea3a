// The volume part of a bake against numbers derived on paper and against the reference.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "gi/surface/swept_boxes.h"
#include "gi/transport/path_trace/path_trace.h"
#include "volume_scenes.h"

namespace daylit {
namespace {

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

std::string why_of_volume(const Baked& baked) {
    for (const PlanItem& item : baked.plan)
        if (item.part == "volume") return item.why;
    return {};
}

// A metre's cube of stone in a lit room, and one of two plates walled up in it.
TEST(VolumeBake, what_is_inside_of_a_wall_is_lit_as_beside_it) {
    const Material wall = lambert(Rgb(0.5f), Rgb(50.0f));
    TestScene made = room(wall, wall, wall, Vec3(4));
    made.box(0, Vec3(1.5f), Vec3(2.5f));
    BakeSettings settings = one_hour();
    settings.parts = {"volume"};
    const Baked baked = bake(with_plates(made, {Vec3(1, 3, 1), Vec3(2)}), settings);
    ASSERT_TRUE(baked.volume);
    EXPECT_NE(why_of_volume(baked).find("'node 2' rests inside of something solid"), std::string::npos);
    EXPECT_EQ(why_of_volume(baked).find("'node 1'"), std::string::npos);
    // As in the furnace, which the cube is a part of.
    for (const Vec3& n : kNormals) EXPECT_NEAR(at(baked, Vec3(2), n).g, kPi * 100.0, 0.1 * kPi * 100.0);
}

TEST(VolumeBake, is_left_out_where_no_free_space_is_reached) {
    TestScene made = room(lambert(Rgb(0.5f)), lambert(Rgb(0.5f)), lambert(Rgb(0.5f)), Vec3(4));
    made.box(0, Vec3(1.5f), Vec3(2.5f));
    BakeSettings settings = one_hour();
    settings.parts = {"volume"};
    const Baked baked = bake(with_plate(made, Vec3(2)), settings);
    EXPECT_FALSE(baked.volume);
    EXPECT_NE(why_of_volume(baked).find("no free space"), std::string::npos);
}

TEST(VolumeBake, levels_that_cannot_be_afforded_are_refused) {
    const Scene scene = with_plate(room(lambert(Rgb(0.5f)), lambert(Rgb(0.5f)), lambert(Rgb(0.5f)), Vec3(2)), Vec3(1));
    const auto refusal = [&](const VolumeSettings& volume) -> std::string {
        BakeSettings settings = one_hour();
        settings.error = 1.0, settings.parts = {"volume"}, settings.volume = volume;
        try {
            bake(scene, settings);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    };
    EXPECT_NE(refusal({.min_level = 20}).find("--volume-min-level: asks for"), std::string::npos);
    EXPECT_NE(refusal({.min_level = 20}).find(" GB; a bake may use 4 GB: give "), std::string::npos);
    EXPECT_NE(refusal({.most_cells = 1000000000}).find("--volume-cells: asks for 1e+09 cells"), std::string::npos);
    EXPECT_EQ(refusal({.max_level = 0}), "");
    EXPECT_EQ(refusal({.max_level = 20}), "");  // the number of cells ends it
}

TEST(VolumeBake, oats_controls_split_cells) {
    const Scene scene =
        with_plate(room(lambert(Rgb(0.5f), Rgb(50.0f)), lambert(Rgb(0.5f)), lambert(Rgb(0.2f)), Vec3(2)), Vec3(1));
    const auto cells = [&](VolumeSettings volume) {
        BakeSettings settings = one_hour();
        volume.error = 1.0f, volume.most_cells = 4000, volume.rays = 96;
        settings.error = 1.0, settings.parts = {"volume"}, settings.volume = volume;
        return bake(scene, settings).volume->tree.cells.size();
    };
    const std::size_t roots = cells({.max_level = 0});
    EXPECT_GE(roots, 512u);                                     // and those that reach over the walls
    EXPECT_GT(cells({.min_level = 1, .max_level = 1}), 4000u);  // the budget, which what is asked for may exceed
    EXPECT_GT(cells({.max_level = 1, .change = 0.05f}), roots);
    EXPECT_GT(cells({.max_level = 1, .harmonic_mean = 1.5f}), roots);
    EXPECT_GT(cells({.max_level = 1, .geometry_level = 1}), roots);
}

TEST(VolumeBake, is_left_out_with_a_reason_where_nothing_moves) {
    Scene scene = with_plate(room(lambert(Rgb(0.5f)), lambert(Rgb(0.5f)), lambert(Rgb(0.5f)), Vec3(2)), Vec3(1));
    scene.nodes[1].dynamic = false;
    BakeSettings settings = one_hour();
    settings.error = 1.0;
    const Baked baked = bake(scene, settings);
    EXPECT_FALSE(baked.volume);
    EXPECT_EQ(why_of_volume(baked), "no dynamic node");
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
