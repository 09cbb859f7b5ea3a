#pragma once
// Indirect light in free space over the day, for what moves: radiance SH and its change from place to place, at the
// corners of an octree's cells (Oat 2005), blended so that no border between cells shows.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/baked/light_basis.h"
#include "engine/baked/volume_tree.h"

namespace daylit {

/// Of a record's value: RGB of each coefficient.
inline constexpr std::size_t kRecordNumbers = glsl::kVolumeNumbers;

/// Steps that numbers of the three bands are kept in, over the record's. The clamped cosine weighs bands by pi, 2 pi /
/// 3 and pi / 4 (shaders/shared/sh.h): with these, errors of irradiance are much the same from each, which takes the
/// fewest bits.
inline constexpr std::array<float, 3> kBandSteps = {1.0f, 2.0f, 4.0f};
/// number   coefficient * 3 + channel
inline constexpr float band_step(std::size_t number) {
    return kBandSteps[number < 3 ? 0 : number < 12 ? 1 : 2];
}

/// What is stored is *indirect* light: what comes from sky and surfaces, not straight from suns and lamps.
struct IrradianceVolume {
    VolumeTree tree;
    LightBasis basis;
    /// RGB of each sampled record's radiance SH (shaders/shared/sh.h), in the record's steps; cd/m^2 once multiplied by
    /// the weights: [component][coefficient * 3 + channel][record].
    std::vector<std::int16_t> values;
    /// Its change along x, y and z over the side of the largest cell that shares the record, in steps of changes:
    /// [component][axis][coefficient * 3 + channel][record].
    std::vector<std::int8_t> changes;
    /// What a step is times band_step(): [channel][record], so that a dark room beside a bright one keeps its light,
    /// and a dim channel its colour; not negative.
    std::vector<float> value_step, change_step;

    /// Bytes that a renderer keeps: cells, and the records of one moment.
    std::size_t memory() const;
    /// All records of one moment, weights = basis.weights(...): glsl::kVolumeNumbers vec4 each.
    std::vector<Vec4> records(std::span<const Rgb> weights) const;
};

/// A volume at one moment.
class VolumeLight {
  public:
    /// The volume, not empty, must outlive this.
    VolumeLight(const IrradianceVolume& volume, std::span<const Rgb> weights)
        : volume_(volume), records_(volume.records(weights)) {}

    /// *Indirect* irradiance in lux on a plane with this unit normal; beside the volume as at the nearest place in it,
    /// never negative. Same as the shader's look-up. Of many places at once: VolumeBatch.
    Rgb irradiance(const Vec3& place, const Vec3& normal) const;
    /// Radiance SH, cd/m^2.
    glsl::VolumeSh radiance(const Vec3& place) const;

    const VolumeTree& tree() const { return volume_.tree; }
    glsl::VolumeArrays arrays() const;
    std::span<const Vec4> records() const { return records_; }

  private:
    const IrradianceVolume& volume_;
    std::vector<Vec4> records_;
};

}  // namespace daylit
