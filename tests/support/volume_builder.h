#pragma once
// Irradiance volumes of equal cells, made by hand.
#include <algorithm>
#include <cmath>

#include "engine/baked/irradiance_volume.h"

namespace daylit {

/// size[0] x size[1] x size[2] cells of a metre, lit by one component whose weight is 1 at all times.
/// value   (record, coefficient, channel); record (x, y, z) of the corners, x fastest
template <class Value>
IrradianceVolume volume_of(const Vec3& origin, const std::array<int, 3>& size, const Value& value) {
    IrradianceVolume volume;
    VolumeTree& tree = volume.tree;
    tree.origin = origin, tree.size = size;
    const auto record = [&](int x, int y, int z) { return std::uint32_t((z * (size[1] + 1) + y) * (size[0] + 1) + x); };
    for (int z = 0; z < size[2]; ++z)
        for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x) {
                tree.nodes.push_back(glsl::kVolumeCell | std::uint32_t(tree.cells.size()));
                tree.cells.push_back(
                    {Vec4(origin + Vec3(x, y, z), 1.0f),
                     {record(x, y, z), record(x + 1, y, z), record(x, y + 1, z), record(x + 1, y + 1, z)},
                     {record(x, y, z + 1), record(x + 1, y, z + 1), record(x, y + 1, z + 1),
                      record(x + 1, y + 1, z + 1)}});
            }
    tree.samples = record(size[0], size[1], size[2]) + 1;
    volume.basis.hours = {12.0};
    volume.basis.components = 1;
    volume.basis.curves = {0, 0, 0, 0, 1};
    std::vector<float> all;
    float largest = 0.0f;
    for (int i = 0; i < glsl::kVolumeNumbers; ++i)
        for (std::uint32_t s = 0; s < tree.samples; ++s) {
            all.push_back(float(value(int(s), i / 3, i % 3)));
            largest = std::max(largest, std::abs(all.back()));
        }
    const float step = std::exp2(std::ceil(std::log2(largest / 32767.0f)));  // whole numbers stay as they are
    for (std::size_t i = 0; i < all.size(); ++i)
        volume.values.push_back(std::int16_t(std::lround(all[i] / (step * band_step(i / tree.samples)))));
    volume.value_step.assign(3 * tree.samples, step);
    volume.changes.assign(3 * volume.values.size(), 0);
    volume.change_step.assign(3 * tree.samples, 0.0f);
    return volume;
}

inline VolumeLight light_of(const IrradianceVolume& volume) {
    return VolumeLight(volume, volume.basis.weights({}, 12.0));
}

}  // namespace daylit
