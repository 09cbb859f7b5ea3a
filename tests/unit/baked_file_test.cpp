#include "engine/baked/baked_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <glm/gtc/packing.hpp>

#include "engine/baked/integer_coding.h"
#include "engine/baked/light_basis_bytes.h"
#include "engine/baked/record_coding.h"
#include "engine/baked/volume_sections.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

#include "tests/support/volume_builder.h"

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

/// 2 x 2 texels, two patterns, two components, three keyframes; every number below is looked up by hand in the tests.
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
    LightBasis& basis = map.basis;
    basis.hours = {6.0, 12.0, 18.0};
    basis.suns = 1, basis.skies = 3;
    basis.sky_level = {1.0f, 100.0f, 1.0f};
    basis.components = 2;
    basis.curves = {0.5f, 1.0f,  2.0f, 1.0f, 3.0f, 0.0f, 0.0f, 0.0f, 0.0f,  // S, K at three hours, O, G, N, V, C
                    0.0f, -1.0f, 0.0f, 5.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.25f};
    map.tile_patterns = {2};
    map.scales = {1.0f, 0.5f};
    map.patterns = {1, 0, 2, 0, 4, 0,   // the first shines as the first component: red, twice as much green, four times
                    0, 2, 0, 4, 0, 8};  // as much blue; the other as half the second
    map.values = {1,  2, 3, 16,         // pattern 0, texels in row order; the last is a quarter of this
                  10, 0, 0, -4};        // pattern 1
    map.exponents = {0, 0, 0, 1};
    map.error = 0.01;
    map.corner_uvs = {{0.25f, 0.25f}, {0.75f, 0.25f}, {0.25f, 0.75f}};
    baked.plan = {{"lightmap", true, "static surfaces", 0, 0.125}, {"volume", false, "no dynamic node", 0, -1.0}};
    return baked;
}

/// The same, and the only tile has tilts.
Baked tilted_bake() {
    Baked baked = small_bake();
    baked.lightmap->tile_tilted = {1};
    baked.lightmap->tilts = {1, 2,  3, 4, 5, 6, 7, -8,   // pattern 0, along u and v
                             0, -9, 0, 0, 0, 0, 0, 12};  // pattern 1
    return baked;
}

/// Two cells, one component, one keyframe.
IrradianceVolume small_volume() {
    return volume_of(Vec3(1, 2, 3), {2, 1, 1}, [](int record, int i, int c) { return record + 10 * i + c; });
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
    EXPECT_EQ(a.lightmap->tile_patterns, b.lightmap->tile_patterns);
    EXPECT_EQ(a.lightmap->scales, b.lightmap->scales);
    EXPECT_EQ(a.lightmap->patterns, b.lightmap->patterns);
    EXPECT_EQ(a.lightmap->values, b.lightmap->values);
    EXPECT_EQ(a.lightmap->exponents, b.lightmap->exponents);
    EXPECT_EQ(a.lightmap->tile_tilted, b.lightmap->tile_tilted);
    EXPECT_EQ(a.lightmap->tilts, b.lightmap->tilts);
    EXPECT_EQ(a.lightmap->error, b.lightmap->error);
    EXPECT_EQ(a.lightmap->basis.suns, b.lightmap->basis.suns);
    EXPECT_EQ(a.lightmap->basis.skies, b.lightmap->basis.skies);
    EXPECT_EQ(a.lightmap->basis.sky_level, b.lightmap->basis.sky_level);
    EXPECT_EQ(a.lightmap->corner_uvs, b.lightmap->corner_uvs);
    EXPECT_EQ(a.lightmap->basis.hours, b.lightmap->basis.hours);
    EXPECT_EQ(a.lightmap->basis.components, b.lightmap->basis.components);
    EXPECT_EQ(a.lightmap->basis.curves, b.lightmap->basis.curves);
}

TEST_F(BakedFile, RoundTripsAndCountsItsBytes) {
    // To freeze a new version: DAYLIT_FREEZE=tests/frozen/version_N.daylit test_unit
    // --gtest_filter='BakedFile.RoundTrips*'
    if (const char* frozen = std::getenv("DAYLIT_FREEZE")) write_baked(frozen, small_bake());
    write_baked(path(), small_bake());
    const Baked read = read_baked(path());
    expect_same(small_bake(), read);
    EXPECT_GT(read.plan[0].bytes, 0u);
    EXPECT_LT(read.plan[0].bytes, fs::file_size(path()));
    EXPECT_EQ(read.plan[1].bytes, 0u);
}

TEST_F(BakedFile, TiltsRoundTrip) {
    write_baked(path(), tilted_bake());
    expect_same(tilted_bake(), read_baked(path()));
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
        const VolumeTree &tree = read.volume->tree, &expected = baked.volume->tree;
        EXPECT_EQ(tree.origin, expected.origin);
        EXPECT_EQ(tree.side, expected.side);
        EXPECT_EQ(tree.size, expected.size);
        EXPECT_EQ(tree.nodes, expected.nodes);
        EXPECT_EQ(tree.samples, expected.samples);
        ASSERT_EQ(tree.cells.size(), expected.cells.size());
        for (std::size_t c = 0; c < tree.cells.size(); ++c) {
            EXPECT_EQ(tree.cells[c].box, expected.cells[c].box);
            EXPECT_EQ(tree.cells[c].low, expected.cells[c].low);
            EXPECT_EQ(tree.cells[c].high, expected.cells[c].high);
        }
        EXPECT_EQ(read.volume->basis.curves, baked.volume->basis.curves);
        EXPECT_EQ(read.volume->values, baked.volume->values);
        EXPECT_EQ(read.volume->changes, baked.volume->changes);
        EXPECT_EQ(read.volume->value_step, baked.volume->value_step);
        EXPECT_EQ(read.volume->change_step, baked.volume->change_step);
        EXPECT_GT(read.plan[1].bytes, 0u);
    }
}

// Records were coded otherwise in files of before, under another name: not to be read as what they are not.
TEST_F(BakedFile, RecordsOfBeforeAreRefusedByName) {
    std::vector<CodedSection> sections = code_volume(small_volume());
    write_sections(path(), sections);
    EXPECT_EQ(read_volume(SectionFile(path())).values, small_volume().values);
    sections.back().entry.name = {'V', 'O', 'R', 'E'};
    write_sections(path(), sections);
    try {
        read_volume(SectionFile(path()));
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(kRecordSection), std::string::npos) << error.what();
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
    expect_refused([](Baked& b) { b.lightmap->basis.curves[4] = std::nanf(""); });
    expect_refused([](Baked& b) { b.lightmap->basis.sky_level[0] = 0.0f; });
    expect_refused([](Baked& b) { b.lightmap->basis.suns = 2, b.lightmap->basis.curves.resize(20); });
    constexpr std::uint8_t kTooMany = DayLightmap::kMostPatterns + 1;
    expect_refused([](Baked& b) {
        b.lightmap->tile_patterns[0] = kTooMany, b.lightmap->scales.resize(kTooMany);
        b.lightmap->patterns.resize(6 * kTooMany), b.lightmap->values.resize(4 * kTooMany);
    });
    expect_refused([](Baked& b) { b.lightmap->tile_patterns.push_back(0); });
    expect_refused([](Baked& b) { b.lightmap->values[3] = 2048; });
    expect_refused([](Baked& b) { b.lightmap->exponents[3] = 8; });
    expect_refused([](Baked& b) { b.lightmap->exponents.pop_back(); });
    expect_refused([](Baked& b) { b.lightmap->scales[0] = INFINITY; });
    expect_refused([](Baked& b) { b.lightmap->scales.pop_back(); });
    expect_refused([](Baked& b) { b = tilted_bake(), b.lightmap->tilts[5] = -2048; });
    expect_refused([](Baked& b) { b = tilted_bake(), b.lightmap->tile_tilted.push_back(0); });
    expect_refused([](Baked& b) { b = tilted_bake(), b.lightmap->tile_tilted[0] = 2; });
    expect_refused([](Baked& b) { b.lightmap->width = 0; });
    expect_refused([](Baked& b) { b.lightmap->corner_uvs[1].x = 1.5f; });
    expect_refused([](Baked& b) { b.lightmap->corner_uvs.pop_back(); });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->tree.side = 0.0f; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->tree.size[1] = 0; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->tree.size = {4096, 4096, 4096}; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->tree.cells.clear(); });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->tree.cells[1].high.z = 12; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->tree.nodes[1] = 0; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->values.pop_back(); });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->value_step[5] = -1.0f; });
    expect_refused([](Baked& b) { b.volume = small_volume(), b.volume->change_step[5] = INFINITY; });
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

TEST_F(BakedFile, PartsThatAreNotWantedStayUnread) {
    write_baked(path(), small_bake());
    auto damaged = read_file(path());
    damaged.back() ^= 1u;  // in the lightmap's texels
    write_file(path(), damaged);
    EXPECT_THROW(read_baked(path()), Error);
    const Baked read = read_baked(path(), {.lightmap = false});
    EXPECT_FALSE(read.lightmap);
    EXPECT_EQ(read.light, small_bake().light);
}

TEST(LightBasisBytes, RoundingAgainChangesNothing) {
    LightBasis basis = small_bake().lightmap->basis;
    for (std::size_t i = 0; i < basis.curves.size(); ++i) basis.curves[i] += 0.1f * float(i);
    const LightBasis once = rounded(basis);
    EXPECT_EQ(rounded(once).curves, once.curves);
    for (std::size_t i = 0; i < basis.curves.size(); ++i) EXPECT_NEAR(once.curves[i], basis.curves[i], 2e-4f);
    ByteWriter w;
    put_basis(w, once);
    ByteReader r(w.take(), "a file", "a section");
    EXPECT_EQ(get_basis(r).curves, once.curves);
}

TEST(IntegerCoding, EveryNumberComesBack) {
    std::vector<std::int16_t> values;
    for (int v = -32768; v < 32768; v += 7) values.push_back(std::int16_t(v));
    values.push_back(32767);
    ByteWriter w;
    put_integers(w, values);
    ByteReader r(w.take(), "a file", "a section");
    EXPECT_EQ(get_integers(r, values.size()), values);
}

TEST(IntegerCoding, SmallNumbersComeBackFromFewBytes) {
    std::vector<std::int16_t> values(4000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::int16_t(i % 3) - 1;
    ByteWriter few;
    put_small_integers(few, values);
    Bytes bytes = few.take();
    EXPECT_EQ(bytes.size(), 8u + 1000u);
    ByteReader r(std::move(bytes), "a file", "a section");
    EXPECT_EQ(get_small_integers(r, values.size()), values);

    for (int v = -32768; v < 32768; v += 7) values.push_back(std::int16_t(v));
    values.push_back(32767), values.push_back(-32768);
    ByteWriter w;
    put_small_integers(w, values);
    bytes = w.take();
    ByteReader all(bytes, "a file", "a section");
    EXPECT_EQ(get_small_integers(all, values.size()), values);
    bytes.pop_back();
    ByteReader cut(bytes, "a file", "a section");
    EXPECT_THROW(get_small_integers(cut, values.size()), Error);
}

TEST(RecordCoding, PlanesComeBackWhateverTheyDifferBy) {
    std::vector<std::int8_t> numbers;
    for (int i = 0; i < 3 * 256 * 2; ++i) numbers.push_back(std::int8_t(i * i / 7 + 31 * i));
    ByteWriter w;
    put_planes<std::int8_t>(w, numbers, 256);
    ByteReader r(w.take(), "a file", "a section");
    EXPECT_EQ(get_planes<std::int8_t>(r, numbers.size(), 256), numbers);
}

TEST(RecordCoding, ChannelsThatAreAlikeTakeNoMoreThanOne) {
    std::vector<std::int16_t> gray(3 * 1000);
    for (std::size_t i = 0; i < gray.size(); ++i) gray[i] = std::int16_t(500 + i % 1000);
    ByteWriter w;
    put_planes<std::int16_t>(w, gray, 1000);
    EXPECT_EQ(w.take().size(), 8u + 750u + 2000u);  // two bits each, and two bytes more of green's
}

TEST(DayLightmap, FetchesBilinearly) {
    const DayLightmap map = *small_bake().lightmap;
    const std::vector<Rgb> first = map.tile_light(std::vector<Rgb>{Rgb(1.0f), Rgb(0.0f)});
    EXPECT_EQ(map.irradiance({0.25f, 0.25f}, first), Rgb(1, 2, 4));  // texel centre
    EXPECT_EQ(map.irradiance({0.75f, 0.75f}, first), Rgb(4, 8, 16));
    EXPECT_EQ(map.irradiance({0.5f, 0.5f}, first), Rgb(2.5f, 5, 10));  // mean of the four
    EXPECT_EQ(map.irradiance({0.5f, 0.25f}, first), Rgb(1.5f, 3, 6));
    EXPECT_EQ(map.irradiance({0.0f, 0.0f}, first), Rgb(1, 2, 4));  // held at the border
}

TEST(DayLightmap, LeanedNormalsFollowTheTilts) {
    const Baked baked = tilted_bake();
    const DayLightmap& map = *baked.lightmap;
    const std::vector<Rgb> light = map.tile_light(map.basis.weights({.sun = Rgb(1.0f)}, 12.0));
    const Vec2 uv(0.75f, 0.25f);
    const Rgb flat = map.irradiance(uv, light), first = light[0], second = light[1];
    EXPECT_EQ(map.irradiance(uv, Vec3(0, 0, 1), light), flat);
    const Rgb tilt_u = 4.0f * (2.0f * first - 9.0f * second), tilt_v = 4.0f * 6.0f * first;
    for (const Vec3& lean : {Vec3(0.1f, 0.0f, 0.99f), Vec3(-0.2f, 0.1f, 0.9f)}) {
        const Rgb expected = max(flat * (0.5f + 0.5f * lean.z) + lean.x * tilt_u + lean.y * tilt_v, Rgb(0.0f));
        EXPECT_LT(glm::distance(map.irradiance(uv, lean, light), expected), 1e-4f * (1.0f + glm::length(expected)));
    }
}

TEST(DayLightmap, IsNeverNegative) {
    const DayLightmap map = *small_bake().lightmap;
    const std::vector<Rgb> second = map.tile_light(std::vector<Rgb>{Rgb(0.0f), Rgb(1.0f)});
    EXPECT_EQ(map.irradiance({0.75f, 0.75f}, second), Rgb(0.0f));
    // The negative texel counts as black in the mean: 10 / 4.
    EXPECT_EQ(map.irradiance({0.5f, 0.5f}, second), Rgb(2.5f, 5, 10));
}

TEST(DayLightmap, EveryPartOfLightHasItsOwnScale) {
    const DayLightmap map = *small_bake().lightmap;
    const auto at = [&](const LightScales& scales, double hour) {
        return map.irradiance({0.25f, 0.25f}, map.tile_light(map.basis.weights(scales, hour)));
    };
    // Pattern 0 (value 1) shines with component 0, pattern 1 (value 10) with component 1; the lamps give 0.25 of this.
    EXPECT_EQ(at({.evening = 0.0f}, 3.0), Rgb(2.5f, 5, 10));
    EXPECT_EQ(at({.sun = Rgb(2, 0, 0), .evening = 0.0f}, 3.0), Rgb(3.5f, 5, 10));
    EXPECT_EQ(at({.clear = 1.0f, .evening = 0.0f}, 12.0), Rgb(2.5f, 5, 10) + 200.0f * Rgb(1, 2, 4));
    EXPECT_EQ(at({.overcast = Rgb(0, 1, 0), .evening = 0.0f}, 12.0), Rgb(2.5f, 5 + 6, 10));
}

}  // namespace
}  // namespace daylit
