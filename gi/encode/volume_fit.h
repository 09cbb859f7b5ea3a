#pragma once
// Records of a volume from all samples that were taken in its cells, not from those at corners alone: corners inside of
// walls, where nothing can be measured, then hold what makes their cells right in the open, and noise averages out.
#include "gi/encode/volume_refine.h"

namespace daylit {

struct VolumeFit {
    std::vector<float> records;  // [sampled record][part 4][numbers]; parts are the value and its change along x, y, z
    std::vector<bool> measured;  // by record; not where its corner is inside of a wall, or behind one
};

/// Least squares over values at corners, in the middle of cells and faces, and the changes that the corners' own rays
/// told.
/// blend   what will interpolate the records
VolumeFit fit_volume(const OctreeCells& cells, const RefinedVolume& refined, std::size_t numbers, VolumeBlend blend);

/// Whether light is the same at a corner for two cells, judged by rays between places that they were tested at.
SameLight same_light_by_rays(const RefinedVolume& refined, const FreeSpace& space);

}  // namespace daylit
