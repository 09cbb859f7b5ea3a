#include "engine/baked/lightmap_sections.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

#include "engine/baked/integer_coding.h"
#include "engine/baked/light_basis_bytes.h"

namespace daylit {
namespace {

constexpr std::uint32_t kMaxSide = 16384;
constexpr std::size_t kMostValues = std::size_t(1) << 29;
constexpr float kUvSteps = 64.0f;  // a texel; its centre is one of them, so that no coordinate moves past a centre

struct Shape {
    DayLightmap map;
    std::size_t corners = 0;
};

Bytes code_shape(const DayLightmap& map) {
    ByteWriter w;
    w.put(std::uint32_t(map.width)), w.put(std::uint32_t(map.height)), w.put(std::uint32_t(map.corner_uvs.size()));
    w.put(map.error);
    put_basis(w, map.basis);
    w.put_all(map.tile_patterns);
    return w.take();
}

Shape decode_shape(ByteReader r) {
    Shape shape;
    DayLightmap& map = shape.map;
    map.width = int(r.number<std::uint32_t>(1, kMaxSide, "the lightmap's width"));
    map.height = int(r.number<std::uint32_t>(1, kMaxSide, "the lightmap's height"));
    shape.corners = r.get<std::uint32_t>();
    if (shape.corners % 3 != 0) r.fail("counts corners that are not three per triangle");
    map.error = r.finite();
    map.basis = get_basis(r);
    map.tile_patterns = r.get_all<std::uint8_t>(map.tiles());
    for (std::uint8_t count : map.tile_patterns)
        if (count > DayLightmap::kMostPatterns) r.fail("has a tile of too many patterns");
    if (std::size_t(map.slots()) * map.texels() > kMostValues) r.fail("has too many texels");
    r.expect_end();
    return shape;
}

/// Steps from each corner to the next, u apart from v, the four bytes of each apart.
Bytes code_corner_uvs(const DayLightmap& map) {
    ByteWriter w;
    for (int axis = 0; axis < 2; ++axis) {
        const float steps = kUvSteps * float(axis == 0 ? map.width : map.height);
        Bytes bytes(4 * map.corner_uvs.size());
        std::uint32_t before = 0;
        for (std::size_t i = 0; i < map.corner_uvs.size(); ++i) {
            const auto at = std::uint32_t(std::lround(map.corner_uvs[i][axis] * steps));
            const std::uint32_t step = at - before, folded = (step << 1) ^ (step >> 31 ? ~0u : 0u);
            for (std::size_t b = 0; b < 4; ++b) bytes[b * map.corner_uvs.size() + i] = std::uint8_t(folded >> (8 * b));
            before = at;
        }
        w.put_all(bytes);
    }
    return w.take();
}

void decode_corner_uvs(ByteReader r, std::size_t corners, DayLightmap& map) {
    map.corner_uvs.resize(corners);
    for (int axis = 0; axis < 2; ++axis) {
        const float steps = kUvSteps * float(axis == 0 ? map.width : map.height);
        const std::vector<std::uint8_t> bytes = r.get_all<std::uint8_t>(4 * corners);
        std::uint32_t at = 0;
        for (std::size_t i = 0; i < corners; ++i) {
            std::uint32_t folded = 0;
            for (std::size_t b = 0; b < 4; ++b) folded |= std::uint32_t(bytes[b * corners + i]) << (8 * b);
            at += (folded >> 1) ^ (folded & 1u ? ~0u : 0u);
            if (float(at) > steps) r.fail("leaves the atlas");
            map.corner_uvs[i][axis] = float(at) / steps;
        }
    }
    r.expect_end();
}

std::size_t pattern_count(const DayLightmap& map) {
    std::size_t count = 0;
    for (std::uint8_t n : map.tile_patterns) count += n;
    return count;
}

/// Red and blue are kept as what they differ from green.
Bytes code_patterns(const DayLightmap& map) {
    ByteWriter w;
    w.put_all(map.scales);
    const std::size_t components = std::size_t(map.basis.components), count = pattern_count(map);
    std::vector<std::int16_t> values(map.patterns.size());
    // Component by component, since each has numbers of its own size.
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t r = 0; r < components; ++r) {
            const std::int16_t* pattern = map.patterns.data() + p * 3 * components + r;
            const std::int16_t green = pattern[components];
            for (std::size_t c = 0; c < 3; ++c)
                values[(c * components + r) * count + p] =
                    std::int16_t(std::uint16_t(pattern[c * components] - (c == 1 ? 0 : green)));
        }
    put_integers(w, values);
    return w.take();
}

void decode_patterns(ByteReader r, DayLightmap& map) {
    const std::size_t components = std::size_t(map.basis.components), count = pattern_count(map);
    map.scales = r.get_all<float>(count);
    for (float scale : map.scales)
        if (!std::isfinite(scale)) r.fail("holds a scale that is not finite");
    const std::vector<std::int16_t> values = get_integers(r, 3 * components * count);
    r.expect_end();
    map.patterns.resize(values.size());
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t k = 0; k < components; ++k) {
            const std::int16_t green = values[(components + k) * count + p];
            for (std::size_t c = 0; c < 3; ++c)
                map.patterns[(p * 3 + c) * components + k] =
                    std::int16_t(std::uint16_t(values[(c * components + k) * count + p] + (c == 1 ? 0 : green)));
        }
}

/// A set of planes of numbers, tile by tile: texels' values, or their tilts.
struct Planes {
    std::vector<std::int16_t> DayLightmap::*numbers;
    int a_slot;         // planes for each slot
    bool tilted_tiles;  // numbers in those alone
};
constexpr Planes kValuePlanes{&DayLightmap::values, 1, false}, kTiltPlanes{&DayLightmap::tilts, 2, true};

/// Calls use(x, y) for the texels of every tile that has numbers in a plane, tile by tile.
template <class Use>
void for_tiles(const DayLightmap& map, const Planes& planes, int plane, const Use& use) {
    for (int tile = 0; tile < int(map.tiles()); ++tile) {
        if (map.tile_patterns[std::size_t(tile)] <= plane / planes.a_slot) continue;
        if (planes.tilted_tiles && !map.tile_tilted[std::size_t(tile)]) continue;
        const int x0 = tile % map.tiles_across() * map.kTileSide, y0 = tile / map.tiles_across() * map.kTileSide;
        for (int y = y0; y < std::min(y0 + map.kTileSide, map.height); ++y)
            for (int x = x0; x < std::min(x0 + map.kTileSide, map.width); ++x) use(x, y);
    }
}

void put_planes(ByteWriter& w, const DayLightmap& map, const Planes& planes) {
    std::vector<std::int16_t> surprises;
    for (int i = 0; i < map.slots() * planes.a_slot; ++i) {
        const std::int16_t* plane = (map.*planes.numbers).data() + std::size_t(i) * map.texels();
        for_tiles(map, planes, i, [&](int x, int y) {
            surprises.push_back(std::int16_t(plane[std::ptrdiff_t(y) * map.width + x] -
                                             predicted_texel(plane, map.width, map.kTileSide, x, y)));
        });
    }
    put_integers(w, surprises);
}

std::size_t coded_numbers(const DayLightmap& map, const Planes& planes) {
    std::size_t count = 0;
    for (int i = 0; i < map.slots() * planes.a_slot; ++i) for_tiles(map, planes, i, [&](int, int) { ++count; });
    return count;
}

void get_planes(ByteReader& r, const Planes& planes, DayLightmap& map) {
    const std::vector<std::int16_t> surprises = get_integers(r, coded_numbers(map, planes));
    r.expect_end();
    std::vector<std::int16_t>& numbers = map.*planes.numbers;
    numbers.assign(std::size_t(map.slots() * planes.a_slot) * map.texels(), 0);
    const std::int16_t* next = surprises.data();
    for (int i = 0; i < map.slots() * planes.a_slot; ++i) {
        std::int16_t* plane = numbers.data() + std::size_t(i) * map.texels();
        for_tiles(map, planes, i, [&](int x, int y) {
            const int value = predicted_texel(plane, map.width, map.kTileSide, x, y) + *next++;
            if (std::abs(value) > DayLightmap::kLargestValue) r.fail("holds a texel that is out of range");
            plane[std::ptrdiff_t(y) * map.width + x] = std::int16_t(value);
        });
    }
}

Bytes code_texels(const DayLightmap& map) {
    ByteWriter w;
    w.put_all(map.exponents);
    put_planes(w, map, kValuePlanes);
    return w.take();
}

void decode_texels(ByteReader r, DayLightmap& map) {
    map.exponents = r.get_all<std::uint8_t>(map.texels());
    for (std::uint8_t exponent : map.exponents)
        if (exponent > DayLightmap::kLargestExponent) r.fail("holds a texel that is out of range");
    get_planes(r, kValuePlanes, map);
}

Bytes code_tilts(const DayLightmap& map) {
    ByteWriter w;
    w.put_all(map.tile_tilted);
    put_planes(w, map, kTiltPlanes);
    return w.take();
}

void decode_tilts(ByteReader r, DayLightmap& map) {
    map.tile_tilted = r.get_all<std::uint8_t>(map.tiles());
    for (std::uint8_t tilted : map.tile_tilted)
        if (tilted > 1) r.fail("has a tile that neither has tilts nor has none");
    if (3 * std::size_t(map.slots()) * map.texels() > kMostValues) r.fail("has too many texels");
    get_planes(r, kTiltPlanes, map);
}

}  // namespace

std::vector<CodedSection> code_lightmap(const DayLightmap& map) {
    std::vector<CodedSection> sections = {
        code_section("LMAP", code_shape(map)), code_section("LMUV", code_corner_uvs(map)),
        code_section("LMPT", code_patterns(map)), code_section("LMTX", code_texels(map))};
    if (map.tilted()) sections.push_back(code_section("LMTI", code_tilts(map)));
    return sections;
}

bool has_lightmap(const SectionFile& file) {
    return file.has("LMAP");
}

DayLightmap read_lightmap_shape(const SectionFile& file) {
    return decode_shape(file.open("LMAP")).map;
}

DayLightmap read_lightmap(const SectionFile& file) {
    Shape shape = decode_shape(file.open("LMAP"));
    DayLightmap& map = shape.map;
    const std::size_t patterns = pattern_count(map), numbers = coded_numbers(map, kValuePlanes);
    // Each fills members of its own.
    tbb::parallel_invoke(
        [&] {
            if (file.has("LMTI")) decode_tilts(file.open("LMTI", map.tiles() + 4 * numbers), map);
        },
        [&] { decode_texels(file.open("LMTX", map.texels() + 2 * numbers), map); },
        [&] {
            decode_patterns(file.open("LMPT", patterns * (sizeof(float) + 6 * std::size_t(map.basis.components))), map);
        },
        [&] { decode_corner_uvs(file.open("LMUV", 8 * shape.corners), shape.corners, map); });
    return std::move(shape.map);
}

}  // namespace daylit
