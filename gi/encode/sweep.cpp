#include "gi/encode/sweep.h"

#include <cstdio>

#include "gi/encode/volume_budget.h"

namespace daylit {
namespace {

LightmapEncoding tiles(double factor) {
    LightmapSettings settings;
    settings.error *= factor, settings.step *= factor;
    settings.basis.dropped *= factor, settings.basis.keyframes *= factor;
    char name[64];
    std::snprintf(name, sizeof name, "tiles, error %g", settings.error);
    return {"tiles", name, settings};
}

}  // namespace

std::vector<LightmapEncoding> lightmap_encodings() {
    std::vector<LightmapEncoding> all;
    for (const double factor : {1.0, 2.0, 4.0, 8.0}) all.push_back(tiles(factor));
    for (const std::size_t vectors : {5, 10, 20, 40})
        all.push_back({"paper", "paper, " + std::to_string(vectors) + " vectors", PaperSettings{vectors, false}});
    all.push_back({"paper's intervals", "paper's intervals, 20 vectors", PaperSettings{20, true}});
    all.push_back({"paper's intervals", "paper's intervals, frames", PaperSettings{0, true}});
    all.push_back({"frames", "all frames", PaperSettings{0, false}});
    return all;
}

std::vector<SweepPoint> volume_sweep(const BakeSettings& base) {
    std::vector<SweepPoint> sweep;
    const auto add = [&](const char* axis, double value) -> BakeSettings& {
        char name[64];
        std::snprintf(name, sizeof name, axis == std::string("cells") ? "cells x %g" : "error %g", value);
        return sweep.emplace_back(SweepPoint{axis, name, base}).settings;
    };
    for (const double factor : {0.25, 0.5}) add("cells", factor).tuning.cells *= factor;
    for (const double factor : {3.0, 0.5}) add("error", factor * base.error).error *= factor;
    return sweep;
}

std::vector<VolumeModePoint> volume_modes() {
    constexpr VolumeBlend kAdini = VolumeBlend::Adini;
    std::vector<VolumeModePoint> all = {{name(kAdini), {}}};
    all.push_back({"uniform grid", {.blend = VolumeBlend::Trilinear, .grid = true}});
    for (const VolumeBlend blend : kVolumeBlends)
        if (blend != kAdini) all.push_back({name(blend), {.blend = blend}});
    all.push_back({"two bands", {kAdini, VolumeBands::Two}});
    all.push_back({"two bands and ZH3", {kAdini, VolumeBands::Zh3}});
    all.push_back({"four bands", {kAdini, VolumeBands::Four}});
    return all;
}

std::vector<VolumeSettings> volume_sizes(const VolumeScheme& mode, const VolumeSettings& plan,
                                         const std::array<int, 3>& roots) {
    std::vector<VolumeSettings> sizes;
    VolumeSettings settings = plan;
    settings.blend = mode.blend;
    if (mode.grid) {
        constexpr int kMostLevel = 6;
        for (int level = 0; level <= kMostLevel; ++level) {
            if (level > 0 && cells_at_level(roots, level) > 8.0 * double(plan.most_cells)) break;
            settings.min_level = settings.max_level = level;
            sizes.push_back(settings);
        }
        return sizes;
    }
    // Records without changes take less than half the bytes and need more cells for the same error.
    const double largest = mode.blend == VolumeBlend::Trilinear ? 4.0 : 1.0;
    for (const double smaller : {1.0, 2.0, 4.0, 8.0}) {
        settings.most_cells = std::size_t(largest / smaller * double(plan.most_cells));
        if (smaller > 1.0 && double(settings.most_cells) < 1.5 * cells_at_level(roots, 0)) break;
        sizes.push_back(settings);
    }
    return sizes;
}

}  // namespace daylit
