// Volumes as other schemes keep them: on a smooth field known on paper, and what bands and grids are.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "gi/encode/sweep.h"
#include "gi/encode/volume_mode_light.h"
#include "gi/encode/volume_octree.h"
#include "gi/encode/volume_records.h"

namespace daylit {
namespace {

const Vec3 kWave(2.1f, 2.9f, 1.7f);

/// Radiance SH that waves through space, and its change: coefficients below `bands` squared alone.
Vec4 field(std::size_t number, const Vec3& place, std::size_t coefficients = 9) {
    if (number / 3 >= coefficients) return Vec4(0.0f);
    const float phase = 0.4f * float(number), a = glm::dot(kWave, place) + phase, large = number < 3 ? 10.0f : 1.0f;
    return Vec4(large + std::sin(a), std::cos(a) * kWave);
}

IrradianceVolume volume_on(const Octree& octree, std::size_t coefficients = 9) {
    const OctreeCells made = make_cells(octree, [](const Lattice&, const LeafSide&, const LeafSide&) { return true; });
    IrradianceVolume volume;
    volume.tree = made.tree;
    volume.basis.hours = {12.0}, volume.basis.components = 1, volume.basis.curves = {0, 0, 0, 0, 1};
    std::vector<float> records;
    for (const auto& sample : made.samples)
        for (glm::length_t part = 0; part < 4; ++part)
            for (std::size_t i = 0; i < kRecordNumbers; ++i)
                records.push_back(field(i, octree.place(sample.at), coefficients)[part]);
    store_records(records, 0.0f, volume);
    return volume;
}

/// Every leaf at one level, or, with chance, some a level deeper.
Octree octree_of(int level, float deeper = 0.0f) {
    Octree octree(Vec3(0.0f), 1.0f, {2, 2, 2});
    Random random(3, 0, 0);
    for (std::uint32_t n = 0; n < octree.nodes.size(); ++n)
        if (octree.nodes[n].level < level || (octree.nodes[n].level == level && random.next() < deeper))
            octree.split(n);
    return octree;
}

Vec3 random_direction(Random& random) {
    const float z = 2.0f * random.next() - 1.0f, around = 2.0f * float(kPi) * random.next(),
                r = std::sqrt(1.0f - z * z);
    return Vec3(r * std::cos(around), r * std::sin(around), z);
}

double rms(const IrradianceVolume& volume, const VolumeScheme& mode, std::size_t coefficients = 9) {
    const VolumeModeLight light(volume, mode, volume.basis.weights({}, 12.0));
    Random random(5, 0, 0);
    double sum = 0.0;
    constexpr int kPlaces = 4000;
    for (int i = 0; i < kPlaces; ++i) {
        const Vec3 place = 2.0f * Vec3(random.next(), random.next(), random.next()), normal = random_direction(random);
        glsl::VolumeSh truth{};
        for (std::size_t n = 0; n < kRecordNumbers; ++n)
            truth.c[n / 3][glm::length_t(n % 3)] = field(n, place, coefficients).x;
        const Rgb off = light.irradiance(place, normal) - glsl::volume_irradiance(truth, normal, 1.0f);
        sum += double(glm::dot(off, off)) / 3.0;
    }
    return std::sqrt(sum / kPlaces);
}

// Of the same cells. Full extrapolations gain nothing over plain trilinear; half of them do, and Hermite more.
TEST(VolumeModeLight, blends_order_as_they_should_on_a_smooth_field) {
    for (const Octree& octree : {octree_of(2), octree_of(1, 0.3f)}) {
        const IrradianceVolume volume = volume_on(octree);
        const auto error = [&](VolumeBlend blend) { return rms(volume, {.blend = blend}); };
        const double trilinear = error(VolumeBlend::Trilinear), half = error(VolumeBlend::Half);
        EXPECT_GT(error(VolumeBlend::Oat), 0.7 * trilinear);
        EXPECT_LT(half, 0.3 * trilinear);
        EXPECT_LT(error(VolumeBlend::Adini), 0.9 * half);
    }
}

TEST(VolumeModeLight, adini_is_what_the_runtime_does) {
    const IrradianceVolume volume = volume_on(octree_of(1, 0.3f));
    const std::vector<Rgb> weights = volume.basis.weights({}, 12.0);
    const VolumeModeLight mode(volume, {}, weights);
    const VolumeLight runtime(volume, weights);
    Random random(8, 0, 0);
    for (int i = 0; i < 300; ++i) {
        const Vec3 place = 3.0f * Vec3(random.next(), random.next(), random.next()) - 0.5f;
        const Vec3 normal = random_direction(random);
        const Rgb a = mode.irradiance(place, normal), b = runtime.irradiance(place, normal);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-5f * (1.0f + b[c]));
    }
}

TEST(VolumeModeLight, a_grid_is_its_octree_found_without_a_tree) {
    const IrradianceVolume volume = volume_on(octree_of(2));
    const VolumeScheme octree{.blend = VolumeBlend::Trilinear}, grid{.blend = VolumeBlend::Trilinear, .grid = true};
    EXPECT_DOUBLE_EQ(rms(volume, grid), rms(volume, octree));
    EXPECT_LT(stored_bytes(volume, grid), stored_bytes(volume, octree));
    const IrradianceVolume mixed = volume_on(octree_of(1, 0.3f));
    EXPECT_THROW(VolumeModeLight(mixed, grid, mixed.basis.weights({}, 12.0)), Error);
}

TEST(VolumeModeLight, bands_that_light_does_not_have_are_not_missed) {
    const IrradianceVolume volume = volume_on(octree_of(2), 4);
    const VolumeScheme two{.bands = VolumeBands::Two}, three{};
    EXPECT_NEAR(rms(volume, two, 4), rms(volume, three, 4), 1e-6);
    EXPECT_GT(rms(volume_on(octree_of(2)), two), 5.0 * rms(volume_on(octree_of(2)), three));
    EXPECT_LT(stored_bytes(volume, two), stored_bytes(volume, three));
    EXPECT_DOUBLE_EQ(rms(volume, {.bands = VolumeBands::Four}), rms(volume, three));
}

// The clamped cosine's coefficients by quadrature: pi, 2 pi / 3, pi / 4 of bands 0 to 2, none of band 3, some of 4.
TEST(VolumeBands, irradiance_has_no_fourth) {
    const auto legendre = [](int l, double x) {
        switch (l) {
            case 3:
                return 0.5 * (5 * x * x * x - 3 * x);
            case 4:
                return 0.125 * (35 * x * x * x * x - 30 * x * x + 3);
            default:
                return l == 0 ? 1.0 : l == 1 ? x : 0.5 * (3 * x * x - 1);
        }
    };
    const double expected[] = {kPi, 2 * kPi / 3, kPi / 4, 0.0, -kPi / 24};
    constexpr int kSteps = 20000;
    for (int l = 0; l <= 4; ++l) {
        double sum = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double x = (i + 0.5) / kSteps;
            sum += 2 * kPi * x * legendre(l, x) / kSteps;
        }
        EXPECT_NEAR(sum, expected[l], 1e-6) << l;
    }
}

// Even light has no axis and no third band. Of one far light the guess holds 0.547 / 0.631 of the third band.
TEST(Zh3, guesses_the_third_band_along_the_light) {
    glsl::VolumeSh even{}, far{};
    even.c[0] = Rgb(2.0f);
    Random random(2, 0, 0);
    for (int i = 0; i < 20; ++i) {
        const Vec3 axis = random_direction(random), normal = random_direction(random);
        EXPECT_NEAR(zh3_irradiance(even, normal).g, kPi * 2.0 * 0.282094792, 1e-5);
        const glsl::Sh9 y = glsl::sh_basis(axis);
        for (int c = 0; c < 9; ++c) far.c[c] = Rgb(y.c[c] * 1000.0f);
        const glsl::Sh9 lobe = glsl::sh_irradiance_weights(normal);
        double first = 0.0, third = 0.0;
        for (int c = 0; c < 9; ++c) (c < 4 ? first : third) += double(lobe.c[c] * far.c[c].g);
        EXPECT_NEAR(zh3_irradiance(far, normal).g, std::max(first + 0.8672 * third, 0.0), 0.5) << i;
    }
}

TEST(Sweep, VolumeModesStartWithTheRuntimes) {
    const std::vector<VolumeModePoint> modes = volume_modes();
    EXPECT_EQ(modes.front().mode.blend, VolumeBlend::Adini);
    EXPECT_EQ(modes.front().mode.bands, VolumeBands::Three);
    VolumeSettings plan;
    plan.most_cells = 1000;
    const auto octrees = volume_sizes(modes.front().mode, plan, {4, 4, 4});
    ASSERT_GE(octrees.size(), 3u);
    EXPECT_EQ(octrees.front().most_cells, 1000u);
    EXPECT_EQ(volume_sizes({VolumeBlend::Trilinear}, plan, {4, 4, 4}).front().most_cells, 4000u);
    for (const VolumeSettings& grid : volume_sizes({VolumeBlend::Trilinear, VolumeBands::Three, true}, plan, {4, 4, 4}))
        EXPECT_EQ(grid.min_level, grid.max_level);
}

}  // namespace
}  // namespace daylit
