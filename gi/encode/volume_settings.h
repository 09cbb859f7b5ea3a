#pragma once
// How finely a volume is sampled.
#include <cstddef>
#include <cstdint>

#include "gi/encode/volume_modes.h"

namespace daylit {

/// Of a bake's error, what leaving out components of a volume's basis may bring on the mean of all places and hours: a
/// single room in the hour that the sun is in its windows errs by thirty times that.
inline constexpr double kVolumeDropped = 0.03;

/// Oat's controls, and the error that refinement ends at. Level 0 are the octree's roots, an eighth of the level's
/// longest side; each further one halves cells.
struct VolumeSettings {
    // Cells are split until this level whatever light does, even beyond most_cells ...
    int min_level = 0;
    // ... and never below this one, at most 20; negative: cells of a quarter of a metre.
    int max_level = -1;
    // Relative: split where light inside differs from what the corners say by more than this and twice its noise,
    float error = 0.0f;
    // where its change over the cell is more than this share of it,
    float change = 1e9f;
    // where the harmonic mean distance of what a corner sees is below this many sides,
    float harmonic_mean = 0.0f;
    // and where there are surfaces, until this level.
    int geometry_level = 0;
    // The budget, which goes where it takes away most of the mean square error.
    std::size_t most_cells = 0;
    int rays = 0;           // of a sample
    float rounding = 0.0f;  // of a record's own light, by keeping it as whole numbers (volume_records.h)
    std::uint64_t seed = 1;
    /// What refinement and records follow; look-ups of the runtime know Adini alone.
    VolumeBlend blend = VolumeBlend::Adini;
};

}  // namespace daylit
