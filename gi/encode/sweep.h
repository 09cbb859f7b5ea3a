#pragma once
// What `daylit report` compares of the ways to store one solution.
#include <array>
#include <string>
#include <variant>
#include <vector>

#include "gi/encode/encode_lightmap.h"
#include "gi/encode/volume_mode_light.h"
#include "gi/encode/volume_settings.h"
#include "gi/sweep.h"

namespace daylit {

/// The scheme of Bahnsen et al. 2012 (paper_pca.h).
struct PaperSettings {
    std::size_t vectors = 0;  // 0: the frames themselves, as half floats
    bool intervals = false;   // of all frames, those that the paper's test keeps
};

struct LightmapEncoding {
    std::string axis, name;
    std::variant<LightmapSettings, PaperSettings> settings;
};

/// Tiles as bakes keep them (the first), and coarser; the paper's scheme with its own 10 and 20 vectors, and with fewer
/// and more; frames as they are.
std::vector<LightmapEncoding> lightmap_encodings();

/// Bakes of volumes: fewer cells, and the target error, which sets cells and rays.
std::vector<SweepPoint> volume_sweep(const BakeSettings& base);

/// Ways to keep a volume and look it up; the first is the runtime's.
struct VolumeModePoint {
    std::string axis;
    VolumeScheme mode;
};
std::vector<VolumeModePoint> volume_modes();

/// Sizes at which a mode is compared, largest first: of octrees, shares of the plan's number of cells, from four times
/// as many where records have no changes; of grids, levels, smallest first. plan    with nothing left to follow from
/// the error (BakePlan::volume_settings) roots   along x, y, z (VolumeEncoder::roots)
std::vector<VolumeSettings> volume_sizes(const VolumeScheme& mode, const VolumeSettings& plan,
                                         const std::array<int, 3>& roots);

/// Of each size, the steps that records are kept in, times the plan's: fewer cells in finer steps, or more in coarser
/// ones, whichever is the better use of bytes; that is not the same for all modes.
inline constexpr std::array<float, 2> kVolumeSteps = {1.0f, 3.0f};

}  // namespace daylit
