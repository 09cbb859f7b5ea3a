#include "engine/baked/baked_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace daylit {
namespace {

namespace fs = std::filesystem;

class BakedFile : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::temp_directory_path() / ("daylit_baked_file_" + std::to_string(getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path path() const { return folder_ / "small.daylit"; }

  private:
    fs::path folder_;
};

WorldMesh one_triangle() {
    WorldMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}};
    mesh.normals.assign(3, Vec3(0, 1, 0));
    mesh.indices = {0, 1, 2};
    mesh.materials = {0};
    mesh.nodes = {0};
    return mesh;
}

/// 2 x 2 texels, two components, three keyframes; every number below is looked up by hand in the tests.
/// The frozen file holds exactly this.
Baked small_bake() {
    Baked baked;
    baked.light.day.latitude = -12.5;
    baked.light.day.date = {2027, 2, 28};
    baked.light.sun = SunSource::Given;
    baked.light.sky = SkySource::File;
    baked.light.sky_file = "skies/overcast.exr";
    baked.light.clouds = 0.25;
    baked.unit = 0.01;
    baked.lambert = true;
    baked.geometry_hash = 0x0123456789ABCDEFull;
    DayLightmap& map = baked.lightmap.emplace();
    map.width = map.height = 2;
    map.basis = {{6.0, 12.0, 18.0}, 2, {0.0f, 1000.0f, 0.0f, 1.0f, 1.0f, 5.0f}};
    for (float value : {1.0f, 2.0f, 3.0f, 4.0f,      // component 0, texels in row order
                        10.0f, 0.0f, 0.0f, -1.0f})  // component 1
        for (int channel = 0; channel < 3; ++channel)
            map.components.push_back(glm::packHalf1x16(value * float(1 << channel)));
    map.corner_uvs = {{0.25f, 0.25f}, {0.75f, 0.25f}, {0.25f, 0.75f}};
    baked.plan = {{"lightmap", true, "static surfaces", 0, 0.125}, {"volume", false, "no dynamic node", 0, -1.0}};
    return baked;
}

/// Two probes, one component, one keyframe.
IrradianceVolume small_volume() {
    IrradianceVolume volume;
    volume.origin = {1, 2, 3};
    volume.spacing = 0.75f;
    volume.size = {2, 1, 1};
    volume.basis = {{12.0}, 1, {100.0f}};
    for (int i = 0; i < 3 * 9 * 2; ++i) volume.components.push_back(glm::packHalf1x16(float(i)));
    return volume;
}

void expect_same(const Baked& a, const Baked& b) {
    EXPECT_EQ(a.light, b.light);
    EXPECT_EQ(a.unit, b.unit);
    EXPECT_EQ(a.lambert, b.lambert);
    EXPECT_EQ(a.geometry_hash, b.geometry_hash);
    ASSERT_EQ(a.plan.size(), b.plan.size());
    for (std::size_t i = 0; i < a.plan.size(); ++i) {
        EXPECT_EQ(a.plan[i].part, b.plan[i].part);
        EXPECT_EQ(a.plan[i].done, b.plan[i].done);
        EXPECT_EQ(a.plan[i].why, b.plan[i].why);
        EXPECT_EQ(a.plan[i].error, b.plan[i].error);
    }
    ASSERT_TRUE(a.lightmap && b.lightmap);
    EXPECT_EQ(a.lightmap->width, b.lightmap->width);
    EXPECT_EQ(a.lightmap->height, b.lightmap->height);
    EXPECT_EQ(a.lightmap->components, b.lightmap->components);
    EXPECT_EQ(a.lightmap->corner_uvs, b.lightmap->corner_uvs);
    EXPECT_EQ(a.lightmap->basis.hours, b.lightmap->basis.hours);
    EXPECT_EQ(a.lightmap->basis.components, b.lightmap->basis.components);
    EXPECT_EQ(a.lightmap->basis.curves, b.lightmap->basis.curves);
}

TEST_F(BakedFile, RoundTripsAndCountsItsBytes) {
    write_baked(path(), small_bake());
    const Baked read = read_baked(path());
    expect_same(small_bake(), read);
    EXPECT_GT(read.plan[0].bytes, 0u);
    EXPECT_LT(read.plan[0].bytes, fs::file_size(path()));
    EXPECT_EQ(read.plan[1].bytes, 0u);
}

TEST_F(BakedFile, WithoutLightmapRoundTrips) {
    Baked baked = small_bake();
    baked.lightmap.reset();
    write_baked(path(), baked);
    EXPECT_FALSE(read_baked(path()).lightmap);
}

TEST_F(BakedFile, VolumeRoundTrips) {
    for (const bool with_lightmap : {true, false}) {
        Baked baked = small_bake();
        if (!with_lightmap) baked.lightmap.reset();
        baked.volume = small_volume();
        write_baked(path(), baked);
        const Baked read = read_baked(path());
        EXPECT_EQ(read.lightmap.has_value(), with_lightmap);
        ASSERT_TRUE(read.volume);
        EXPECT_EQ(read.volume->origin, baked.volume->origin);
        EXPECT_EQ(read.volume->spacing, baked.volume->spacing);
        EXPECT_EQ(read.volume->size, baked.volume->size);
        EXPECT_EQ(read.volume->basis.hours, baked.volume->basis.hours);
        EXPECT_EQ(read.volume->basis.components, baked.volume->basis.components);
        EXPECT_EQ(read.volume->basis.curves, baked.volume->basis.curves);
        EXPECT_EQ(read.volume->components, baked.volume->components);
        EXPECT_GT(read.plan[1].bytes, 0u);
    }
}

TEST_F(BakedFile, SameBakeSameBytes) {
    write_baked(path(), small_bake());
    const auto first = read_file(path());
    write_baked(path(), small_bake());
    EXPECT_EQ(first, read_file(path()));
}

TEST_F(BakedFile, EveryTruncationIsRefused) {
    write_baked(path(), small_bake());
    const auto whole = read_file(path());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        write_file(path(), std::span(whole).first(length));
        EXPECT_THROW(read_baked(path()), Error) << length << " bytes of " << whole.size();
    }
}

TEST_F(BakedFile, EveryFlippedBitIsRefused) {
    write_baked(path(), small_bake());
    const auto whole = read_file(path());
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        auto damaged = whole;
        damaged[bit / 8] ^= std::uint8_t(1u << (bit % 8));
        write_file(path(), damaged);
        EXPECT_THROW(read_baked(path()), Error) << "bit " << bit;
    }
}

TEST_F(BakedFile, ErrorsNameTheFile) {
    write_file(path(), std::string("not a bake at all, but long enough to hold a header"));
    try {
        read_baked(path());
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("small.daylit"), std::string::npos);
    }
}

// Well-formed files (checksums right) that say impossible things.
TEST_F(BakedFile, ImpossibleContentsAreRefused) {
    const auto expect_refused = [&](auto change) {
        Baked baked = small_bake();
        change(baked);
        write_baked(path(), baked);
        EXPECT_THROW(read_baked(path()), Error);
    };
    expect_refused([](Baked& b) { b.lightmap->basis.hours = {6.0, 6.0, 18.0}; });
    expect_refused([](Baked& b) { b.lightmap->basis.hours = {6.0, 12.0, 25.0}; });
    expect_refused([](Baked& b) { b.lightmap->basis.curves[2] = std::nanf(""); });
    expect_refused([](Baked& b) { b.lightmap->basis.curves.pop_back(); });
    expect_refused([](Baked& b) { b.lightmap->components[3] = 0x7C00; });  // infinity
    expect_refused([](Baked& b) { b.lightmap->components.pop_back(); });
    expect_refused([](Baked& b) { b.lightmap->corner_uvs[1].x = 1.5f; });
    expect_refused([](Baked& b) { b.lightmap->corner_uvs.pop_back(); });
    expect_refused([](Baked& b) { b.lightmap->width = 16384, b.lightmap->height = 16384; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->spacing = 0.0f; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->size[1] = 0; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->size = {4096, 4096, 4096}; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->components.pop_back(); });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->components[5] = 0x7C00; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->basis.curves.push_back(1.0f); });
    expect_refused([](Baked& b) { b.light.turbidity = INFINITY; });
    expect_refused([](Baked& b) { b.light.sky = SkySource(200); });
}

TEST_F(BakedFile, OtherGeometryIsRefusedWithBothNames) {
    Baked baked = small_bake();
    WorldMesh mesh = one_triangle();
    baked.geometry_hash = geometry_hash(mesh);
    EXPECT_NO_THROW(require_same_geometry(baked, "a.daylit", mesh, "b.glb"));
    mesh.positions[1].x = 2.0f;
    try {
        require_same_geometry(baked, "a.daylit", mesh, "b.glb");
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("a.daylit"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("b.glb"), std::string::npos);
    }
}

TEST_F(BakedFile, FrozenVersion1Loads) {
    expect_same(small_bake(), read_baked(fs::path(DAYLIT_TESTS_DIR) / "frozen" / "version_1.daylit"));
}

TEST(DayBasis, WeightsAreLinearBetweenKeyframesAndHeldOutside) {
    const DayBasis basis = small_bake().lightmap->basis;
    EXPECT_EQ(basis.weights(12.0), (std::vector<float>{1000.0f, 1.0f}));
    EXPECT_EQ(basis.weights(9.0), (std::vector<float>{500.0f, 1.0f}));
    EXPECT_EQ(basis.weights(16.5), (std::vector<float>{250.0f, 4.0f}));
    EXPECT_EQ(basis.weights(3.0), (std::vector<float>{0.0f, 1.0f}));
    EXPECT_EQ(basis.weights(23.0), (std::vector<float>{0.0f, 5.0f}));
}

TEST(DayBasis, HoursWrap) {
    const DayBasis basis = small_bake().lightmap->basis;
    EXPECT_EQ(basis.weights(9.0 + 48.0), basis.weights(9.0));
    EXPECT_EQ(basis.weights(9.0 - 24.0), basis.weights(9.0));
    EXPECT_EQ(basis.weights(-1e-30), basis.weights(0.0));
}

TEST(DayBasis, OneKeyframeNeverChanges) {
    const DayBasis basis{{12.0}, 1, {7.0f}};
    for (double hour : {0.0, 11.9, 12.0, 23.9}) EXPECT_EQ(basis.weights(hour), std::vector<float>{7.0f});
}

TEST(DayLightmap, FetchesBilinearly) {
    const DayLightmap map = *small_bake().lightmap;
    const std::vector<float> first = {1.0f, 0.0f};
    EXPECT_EQ(map.irradiance({0.25f, 0.25f}, first), Rgb(1, 2, 4));   // texel centre
    EXPECT_EQ(map.irradiance({0.75f, 0.75f}, first), Rgb(4, 8, 16));
    EXPECT_EQ(map.irradiance({0.5f, 0.5f}, first), Rgb(2.5f, 5, 10));  // mean of the four
    EXPECT_EQ(map.irradiance({0.5f, 0.25f}, first), Rgb(1.5f, 3, 6));
    EXPECT_EQ(map.irradiance({0.0f, 0.0f}, first), Rgb(1, 2, 4));     // held at the border
}

TEST(DayLightmap, IsNeverNegative) {
    const DayLightmap map = *small_bake().lightmap;
    const std::vector<float> weights = {0.0f, 1.0f};
    EXPECT_EQ(map.irradiance({0.75f, 0.75f}, weights), Rgb(0.0f));
    // The negative texel counts as black in the mean: 10 / 4.
    EXPECT_EQ(map.irradiance({0.5f, 0.5f}, weights), Rgb(2.5f, 5, 10));
}

}  // namespace
}  // namespace daylit
