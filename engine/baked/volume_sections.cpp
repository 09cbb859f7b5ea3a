#include "engine/baked/volume_sections.h"

#include "engine/baked/day_basis_bytes.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr std::uint32_t kMaxProbesPerSide = 4096;

Bytes code_shape(const IrradianceVolume& volume) {
    ByteWriter w;
    w.put(volume.origin), w.put(volume.spacing);
    for (int side : volume.size) w.put(std::uint32_t(side));
    w.put(std::uint32_t(volume.basis.components)), w.put(std::uint32_t(volume.basis.hours.size()));
    code_curves(volume.basis, w);
    return w.take();
}

void decode_shape(ByteReader r, IrradianceVolume& volume) {
    volume.origin = r.finite_vec3();
    volume.spacing = r.get<float>();
    if (!(volume.spacing > 0.0f && std::isfinite(volume.spacing))) r.fail("has no spacing");
    for (int& side : volume.size)
        side = int(r.number<std::uint32_t>(1, kMaxProbesPerSide, "the number of probes along a side"));
    volume.basis.components = int(r.number<std::uint32_t>(0, kMaxBasisComponents, "the number of components"));
    decode_curves(r, r.number<std::uint32_t>(1, kMaxKeyframes, "the number of keyframes"), volume.basis);
    r.expect_end();
}

std::size_t probe_halves(const IrradianceVolume& volume) {
    return 3 * std::size_t(glsl::kShCoefficients) * volume.probes() * std::size_t(volume.basis.components);
}

}  // namespace

std::vector<CodedSection> code_volume(const IrradianceVolume& volume) {
    return {code_section("VOLU", code_shape(volume)), code_section("VOSH", bytes_of(volume.components))};
}

bool has_volume(const SectionFile& file) {
    return file.has("VOLU");
}

IrradianceVolume read_volume(const SectionFile& file) {
    IrradianceVolume volume;
    decode_shape(file.open("VOLU"), volume);
    ByteReader r = file.open("VOSH", probe_halves(volume) * sizeof(std::uint16_t));
    volume.components = finite_halves(r, probe_halves(volume), "probe");
    return volume;
}

}  // namespace daylit
