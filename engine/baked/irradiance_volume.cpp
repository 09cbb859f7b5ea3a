#include "engine/baked/irradiance_volume.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace daylit {
namespace {

constexpr std::size_t kAtOnce = 256;  // records of a block, whose numbers stay in the cache from component to component

}  // namespace

std::size_t IrradianceVolume::memory() const {
    return tree.nodes.size() * sizeof(std::uint32_t) + tree.cells.size() * sizeof(glsl::VolumeCell) +
           tree.cuts.size() * sizeof(glsl::VolumeCut) + tree.records() * kRecordNumbers * sizeof(Vec4);
}

std::vector<Vec4> IrradianceVolume::records(std::span<const Rgb> weights) const {
    const std::vector<float> sides = record_sides(tree);
    std::vector<Vec4> result(kRecordNumbers * tree.records(), Vec4(0.0f));
    const std::size_t count = tree.samples;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kAtOnce), [&](const auto& range) {
        for (std::size_t r = 0; r < weights.size(); ++r)
            for (std::size_t i = 0; i < kRecordNumbers; ++i) {
                const float weight = weights[r][glm::length_t(i % 3)];
                if (weight == 0.0f) continue;
                const std::int16_t* value = values.data() + (r * kRecordNumbers + i) * count;
                for (std::size_t s = range.begin(); s < range.end(); ++s)
                    result[s * kRecordNumbers + i].x += weight * float(value[s]);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::int8_t* change = changes.data() + ((r * 3 + axis) * kRecordNumbers + i) * count;
                    for (std::size_t s = range.begin(); s < range.end(); ++s)
                        result[s * kRecordNumbers + i][glm::length_t(1 + axis)] += weight * float(change[s]);
                }
            }
        for (std::size_t s = range.begin(); s < range.end(); ++s)
            for (std::size_t i = 0; i < kRecordNumbers; ++i) {
                const std::size_t step = i % 3 * count + s;
                const float change = change_step[step] / sides[s];  // a metre
                result[s * kRecordNumbers + i] *= band_step(i) * Vec4(value_step[step], change, change, change);
            }
    });
    fill_hanging(tree, result);
    return result;
}

glsl::VolumeArrays VolumeLight::arrays() const {
    const VolumeTree& tree = volume_.tree;
    return {tree.grid(), tree.nodes.data(), tree.cells.data(), tree.cuts.data(), records_.data()};
}

glsl::VolumeSh VolumeLight::radiance(const Vec3& place) const {
    const glsl::VolumeArrays all = arrays();
    return glsl::volume_sh(all, glsl::volume_place(all, place));
}

Rgb VolumeLight::irradiance(const Vec3& place, const Vec3& normal) const {
    return glsl::volume_irradiance(radiance(place), normal, 1.0f);
}

}  // namespace daylit
