#include "engine/baked/lightmap_sections.h"

#include "engine/baked/day_basis_bytes.h"

namespace daylit {
namespace {

constexpr std::uint32_t kMaxSide = 16384;

Bytes code_shape(const DayLightmap& map) {
    ByteWriter w;
    w.put(std::uint32_t(map.width)), w.put(std::uint32_t(map.height));
    w.put(std::uint32_t(map.basis.components)), w.put(std::uint32_t(map.basis.hours.size()));
    w.put(std::uint32_t(map.corner_uvs.size()));
    code_curves(map.basis, w);
    return w.take();
}

/// Returns the number of corners that LMUV must hold.
std::size_t decode_shape(ByteReader r, DayLightmap& map) {
    map.width = int(r.number<std::uint32_t>(1, kMaxSide, "the lightmap's width"));
    map.height = int(r.number<std::uint32_t>(1, kMaxSide, "the lightmap's height"));
    map.basis.components = int(r.number<std::uint32_t>(0, kMaxBasisComponents, "the number of components"));
    const std::size_t keyframes = r.number<std::uint32_t>(1, kMaxKeyframes, "the number of keyframes");
    const std::size_t corners = r.get<std::uint32_t>();
    if (corners % 3 != 0) r.fail("counts corners that are not three per triangle");
    decode_curves(r, keyframes, map.basis);
    r.expect_end();
    return corners;
}

void decode_corner_uvs(ByteReader r, std::size_t corners, DayLightmap& map) {
    map.corner_uvs = r.get_all<Vec2>(corners);
    for (const Vec2& uv : map.corner_uvs)
        if (!(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f)) r.fail("leaves the atlas");
    r.expect_end();
}

std::size_t texel_halves(const DayLightmap& map) {
    return 3 * std::size_t(map.width) * std::size_t(map.height) * std::size_t(map.basis.components);
}

}  // namespace

std::vector<CodedSection> code_lightmap(const DayLightmap& map) {
    return {code_section("LMAP", code_shape(map)), code_section("LMUV", bytes_of(map.corner_uvs)),
            code_section("LMTX", bytes_of(map.components))};
}

bool has_lightmap(const SectionFile& file) {
    return file.has("LMAP");
}

DayLightmap read_lightmap(const SectionFile& file) {
    DayLightmap map;
    const std::size_t corners = decode_shape(file.open("LMAP"), map);
    decode_corner_uvs(file.open("LMUV", corners * sizeof(Vec2)), corners, map);
    ByteReader r = file.open("LMTX", texel_halves(map) * sizeof(std::uint16_t));
    map.components = finite_halves(r, texel_halves(map), "texel");
    return map;
}

}  // namespace daylit
