#pragma once
// What a volume takes while it is baked, and how much of that a bake may ask for.
#include <array>
#include <cstddef>

#include "gi/encode/volume_settings.h"

namespace daylit {

/// Memory of a bake's volume, bytes.
inline constexpr double kVolumeMemory = 4.0e9;

/// Bytes that a cell takes while it is baked: its samples' light, in this many components, and what they are judged by.
double bytes_per_volume_cell(std::size_t components, std::size_t functionals);

/// Cells that a level has where it is split everywhere.
double cells_at_level(const std::array<int, 3>& roots, int level);

/// throws Error, with the memory that it would need and what is affordable, when the number of cells or the least level
/// is not.
void require_affordable(const VolumeSettings& settings, const std::array<int, 3>& roots, double bytes_per_cell);

}  // namespace daylit
