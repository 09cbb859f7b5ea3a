#include "gi/encode/volume_budget.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/base/error.h"
#include "shaders/shared/volume_tree.h"

namespace daylit {
namespace {

// Corners, middles of faces and the centre are sampled, and most are shared with neighbours and children;
// measured on the demo level.
constexpr double kSamplesPerCell = 8.0;

[[noreturn]] void refuse(const char* option, double cells, double bytes_per_cell, double affordable) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "asks for %.3g cells, which need %.3g GB; a bake may use %.3g GB: give %.0f or less", cells,
                  1e-9 * cells * bytes_per_cell, 1e-9 * kVolumeMemory, affordable);
    throw Error(option, text);
}

}  // namespace

double bytes_per_volume_cell(std::size_t components, std::size_t functionals) {
    constexpr double kParts = 4.0;
    const double light = kParts * glsl::kVolumeNumbers * double(components);
    const double judged = (kParts + 1.0) * double(functionals);  // with their noise
    return kSamplesPerCell * (sizeof(std::int16_t) * light + sizeof(float) * judged);
}

double cells_at_level(const std::array<int, 3>& roots, int level) {
    return double(roots[0]) * double(roots[1]) * double(roots[2]) * std::pow(8.0, level);
}

void require_affordable(const VolumeSettings& settings, const std::array<int, 3>& roots, double bytes_per_cell) {
    const double cells = std::floor(kVolumeMemory / bytes_per_cell);
    if (double(settings.most_cells) > cells)
        refuse("--volume-cells", double(settings.most_cells), bytes_per_cell, cells);
    const double asked = cells_at_level(roots, settings.min_level);
    if (settings.min_level > 0 && asked > cells) {
        const double finest = std::floor(std::log2(cells / cells_at_level(roots, 0)) / 3.0);
        refuse("--volume-min-level", asked, bytes_per_cell, std::max(finest, 0.0));
    }
}

}  // namespace daylit
