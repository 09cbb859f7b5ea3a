#pragma once
// How finely a volume is sampled.
#include <cstddef>
#include <cstdint>

namespace daylit {

/// Oat's controls, and the error that refinement ends at. Level 0 are the octree's roots, an eighth of the level's
/// longest side; each further one halves cells.
struct VolumeSettings {
    int min_level = 0;    // cells are split until this level whatever light does
    int max_level = -1;   // and never below this one; negative: cells of a quarter of a metre
    float error = 0.0f;   // relative: split where light inside differs by more than this and twice its noise
    float change = 1e9f;  // split where the light's change over the cell is more than this share of it
    float harmonic_mean =
        0.0f;                // split where the harmonic mean distance of what a corner sees is below this many sides
    int geometry_level = 0;  // cells with surfaces in them are split until this level
    std::size_t most_cells = 0;  // and the budget that they share
    int rays = 0;                // of a sample
    std::uint64_t seed = 1;
};

}  // namespace daylit
