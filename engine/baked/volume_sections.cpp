#include "engine/baked/volume_sections.h"

#include <algorithm>
#include <cmath>

#include "engine/baked/light_basis_bytes.h"
#include "engine/baked/record_coding.h"

namespace daylit {
namespace {

constexpr std::uint32_t kMostRoots = 4096;      // along an axis
constexpr std::uint32_t kMostParts = 1u << 24;  // nodes, cells, records

Bytes code_shape(const IrradianceVolume& volume) {
    const VolumeTree& tree = volume.tree;
    ByteWriter w;
    w.put(tree.origin), w.put(tree.side);
    for (int side : tree.size) w.put(std::uint32_t(side));
    for (const std::size_t count :
         {tree.nodes.size(), tree.cells.size(), tree.cuts.size(), std::size_t(tree.samples), tree.hanging.size()})
        w.put(std::uint32_t(count));
    put_basis(w, volume.basis);
    return w.take();
}

struct Counts {
    std::size_t nodes, cells, cuts, hanging;
};

Counts decode_shape(ByteReader r, IrradianceVolume& volume) {
    VolumeTree& tree = volume.tree;
    tree.origin = r.finite_vec3();
    tree.side = r.get<float>();
    for (int& side : tree.size) side = int(r.number<std::uint32_t>(1, kMostRoots, "the number of roots along a side"));
    const auto count = [&] { return r.number<std::uint32_t>(0, kMostParts, "the number of cells"); };
    Counts counts{};
    counts.nodes = count(), counts.cells = count(), counts.cuts = count();
    tree.samples = count(), counts.hanging = count();
    volume.basis = get_basis(r);
    r.expect_end();
    return counts;
}

Bytes code_tree(const VolumeTree& tree) {
    ByteWriter w;
    w.put_all(tree.nodes), w.put_all(tree.cells), w.put_all(tree.cuts), w.put_all(tree.hanging);
    return w.take();
}

void decode_tree(ByteReader r, const Counts& counts, VolumeTree& tree) {
    tree.nodes = r.get_all<std::uint32_t>(counts.nodes);
    tree.cells = r.get_all<glsl::VolumeCell>(counts.cells);
    tree.cuts = r.get_all<glsl::VolumeCut>(counts.cuts);
    tree.hanging = r.get_all<HangingCorner>(counts.hanging);
    r.expect_end();
    if (const char* what = fault(tree)) r.fail(what);
}

std::size_t tree_bytes(const Counts& c) {
    return c.nodes * 4 + c.cells * sizeof(glsl::VolumeCell) + c.cuts * sizeof(glsl::VolumeCut) +
           c.hanging * sizeof(HangingCorner);
}

Bytes code_records(const IrradianceVolume& volume) {
    ByteWriter w;
    w.put_all(volume.value_step), w.put_all(volume.change_step);
    put_planes<std::int8_t>(w, volume.changes, volume.tree.samples);
    put_planes<std::int16_t>(w, volume.values, volume.tree.samples);
    return w.take();
}

std::vector<float> decode_steps(ByteReader& r, std::size_t count) {
    std::vector<float> steps = r.get_all<float>(count);
    if (!std::all_of(steps.begin(), steps.end(), [](float s) { return std::isfinite(s) && s >= 0.0f; }))
        r.fail("holds a step that is negative or not finite");
    return steps;
}

}  // namespace

std::vector<CodedSection> code_volume(const IrradianceVolume& volume) {
    return {code_section("VOLU", code_shape(volume)), code_section("VOTR", code_tree(volume.tree)),
            code_section(kRecordSection, code_records(volume))};
}

bool has_volume(const SectionFile& file) {
    return file.has("VOLU");
}

IrradianceVolume read_volume(const SectionFile& file) {
    IrradianceVolume volume;
    const Counts counts = decode_shape(file.open("VOLU"), volume);
    decode_tree(file.open("VOTR", tree_bytes(counts)), counts, volume.tree);
    const std::size_t count = volume.tree.samples,
                      numbers = std::size_t(volume.basis.components) * kRecordNumbers * count;
    constexpr double kMostBytes = 2.25;  // of a number
    constexpr std::size_t kCounts = 2 * (sizeof(std::uint64_t) + 1);
    ByteReader r =
        file.open(kRecordSection, 6 * sizeof(float) * count + std::size_t(4 * kMostBytes * double(numbers)) + kCounts);
    volume.value_step = decode_steps(r, 3 * count);
    volume.change_step = decode_steps(r, 3 * count);
    volume.changes = get_planes<std::int8_t>(r, 3 * numbers, count);
    volume.values = get_planes<std::int16_t>(r, numbers, count);
    r.expect_end();
    return volume;
}

}  // namespace daylit
