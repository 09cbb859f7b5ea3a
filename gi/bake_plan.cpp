#include "gi/bake_plan.h"

#include <algorithm>
#include <cmath>

#include "engine/baked/part_plan.h"
#include "engine/base/error.h"

namespace daylit {
namespace {

// Texels: few for scenes of few surfaces (a box needs no more), up to the ceiling for levels. At preview (error 0.10)
// the ceiling keeps two cores busy for half a minute.
constexpr double kFewestTexels = 24000, kTexelsPerTriangle = 8, kPreviewTexels = 240000;
// Rays a texel at preview; noise falls with their root, and filtering over neighbours takes a good part of the rest.
constexpr double kPreviewRays = 48, kPreviewError = 0.10;
// On top, for texels whose noise is largest: a share of those.
constexpr double kMoreRays = 2.0 / 3.0;
constexpr int kFewestRays = 32, kMostRays = 1024;
// Samples of a volume look at the whole sphere and are averaged with few neighbours. A bright window is a hundredth of
// it: of 144 rays one or two meet it, and samples side by side differ by half of their light.
constexpr double kPreviewSampleRays = 432;
constexpr int kFewestSampleRays = 96, kMostSampleRays = 3072;
constexpr double kPreviewCells = 3000, kMostCells = 20000;
// Of how much finer than preview a bake is, for the number of cells: every sample waits in memory until records are
// fitted.
constexpr double kCellsPower = 0.9;
// Of a bake's error, what rounding a volume's records may bring: squares of errors add up.
constexpr double kRounding = 0.1;
// Below it the sun adds nothing to the night's own light (engine/scene/sky.cpp draws no sky there).
constexpr double kDeepNight = -20.0 * kDegree;

std::size_t texel_budget(const SceneFacts& facts, double error) {
    const double finer = kPreviewError / error;
    const double wanted = std::min(kFewestTexels + kTexelsPerTriangle * double(facts.static_triangles), kPreviewTexels);
    return std::size_t(wanted * std::clamp(std::pow(finer, 1.08), 0.25, 4.0));
}

int rays_per_texel(double error) {
    const double rays = kPreviewRays * std::pow(kPreviewError / error, 1.1);
    return std::clamp(int(rays / 16.0 + 0.5) * 16, kFewestRays, kMostRays);
}

int rays_per_sample(double error) {
    const double rays = kPreviewSampleRays * std::sqrt(kPreviewError / error);
    return std::clamp(int(rays / 16.0 + 0.5) * 16, kFewestSampleRays, kMostSampleRays);
}

VolumeSettings volume_settings(const BakeSettings& settings) {
    VolumeSettings result = settings.volume;
    const double finer = kPreviewError / settings.error;
    if (result.error <= 0.0f) result.error = float(std::clamp(0.8 * settings.error, 0.03, 0.2));
    if (result.most_cells == 0)
        result.most_cells = std::size_t(settings.tuning.cells *
                                        std::clamp(kPreviewCells * std::pow(finer, kCellsPower), 500.0, kMostCells));
    if (result.rays == 0) result.rays = rays_per_sample(settings.error);
    if (result.rounding == 0.0f) result.rounding = float(kRounding * settings.error);
    result.seed = settings.seed;
    return result;
}

std::vector<PlanItem> parts_of_this_version(const SceneFacts& facts, const std::vector<std::string>& asked) {
    for (const std::string& part : asked)
        if (!bakes_part(part))
            throw Error("--parts", "'" + part + "' is not baked by this version; lightmap and volume are (or auto)");
    return plan_of_this_version(plan_parts(facts, asked));
}

}  // namespace

std::vector<double> baked_hours(const LightModel& light, double from, double to, double every) {
    if (light.constant()) return {from};
    std::vector<double> all, kept;
    const int steps = int(std::floor((to - from) / every + 1e-6));
    for (int i = 0; i <= steps; ++i) all.push_back(from + i * every);
    if (all.back() < to - 1e-6) all.push_back(to);

    std::vector<bool> dark;
    for (double hour : all) dark.push_back(sun_position(light.settings().day, hour).apparent_elevation < kDeepNight);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool beside_light = (i > 0 && !dark[i - 1]) || (i + 1 < all.size() && !dark[i + 1]);
        const bool only = i == 0 && std::find(dark.begin(), dark.end(), false) == dark.end();
        if (!dark[i] || beside_light || only) kept.push_back(all[i]);
    }
    return kept;
}

BakePlan plan_bake(const SceneFacts& facts, const LightModel& light, const BakeSettings& settings) {
    BakePlan plan;
    plan.parts = parts_of_this_version(facts, settings.parts);
    for (const PlanItem& item : plan.parts) {
        plan.lightmap |= item.part == "lightmap" && item.done;
        plan.volume |= item.part == "volume" && item.done;
    }
    if (!plan.lightmap && !plan.volume) return plan;
    plan.texel_budget = std::size_t(settings.tuning.texels * double(texel_budget(facts, settings.error)));
    plan.rays = std::max(1, int(settings.tuning.rays * rays_per_texel(settings.error)));
    plan.more_rays = kMoreRays * plan.rays;
    plan.volume_settings = volume_settings(settings);
    plan.hours = baked_hours(light, settings.from_hour, settings.to_hour, settings.every_hours);
    return plan;
}

}  // namespace daylit
