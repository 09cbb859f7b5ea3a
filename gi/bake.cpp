#include "gi/bake.h"

#include <algorithm>
#include <cstdio>

#include "gi/encode/encode_lightmap.h"
#include "gi/encode/encode_volume.h"
#include "gi/lightmap_rows.h"
#include "gi/solved_day.h"

namespace daylit {
namespace {

/// Of values with light.
float quantile(std::vector<float> values, double share) {
    std::erase(values, 0.0f);
    if (values.empty()) return 0.0f;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::string describe(const EncodedLightmap& encoded, const Texels& texels, const BakePlan& plan, const DaySolution& day,
                     const LightmapRows& rows) {
    char error[32], patterns[160], noise[160];
    std::snprintf(error, sizeof error, "%.4f", day.basis.error);
    std::snprintf(patterns, sizeof patterns,
                  "kept as %d keyframes and tiles of %.1f components (%d at most), worst tile's error %.3f",
                  int(encoded.map.basis.hours.size()), encoded.mean_patterns, encoded.map.slots(), encoded.worst_tile);
    std::snprintf(noise, sizeof noise,
                  "%d rays each and %.0f more on average where it pays, median standard error %.3f (95th percentile "
                  "%.3f, the worst hour, before smoothing), ",
                  plan.rays, rows.more_rays, double(quantile(rows.noise, 0.5)), double(quantile(rows.noise, 0.95)));
    return std::to_string(texels.count()) + " texels, " + noise + std::to_string(plan.hours.size()) + " hours in " +
           std::to_string(day.basis.components) + " components (error " + error + "), " + std::to_string(day.bounces) +
           " bounces; " +
           (rows.tilts.count() ? std::to_string(rows.tilts.count()) + " texels under normal maps with tilts; " : "") +
           patterns;
}

std::string describe(const EncodedVolume& encoded, const BakePlan& plan) {
    const VolumeTree& tree = encoded.volume.tree;
    std::string text = std::to_string(tree.cells.size()) + " cells, " + std::to_string(tree.cuts.size()) +
                       " of them cut by walls, " + std::to_string(tree.samples) + " corners (" +
                       std::to_string(encoded.unmeasured) + " in walls), " + std::to_string(encoded.samples) +
                       " places sampled with " + std::to_string(plan.volume_settings.rays) + " rays each, " +
                       std::to_string(encoded.volume.basis.components) + " components";
    text += ", " + std::to_string(encoded.volume.memory() >> 10) + " kB at run time";
    if (encoded.budget_spent) text += ", the number of cells ended the refinement";
    for (const std::string& name : encoded.buried)
        text += "; '" + name + "' rests inside of something solid and is lit as the nearest open place is";
    return text;
}

/// Notes in the plan what a part came to.
void note(std::vector<PlanItem>& plan, const char* part, const std::string& why, double error) {
    for (PlanItem& item : plan)
        if (item.part == part) item.why += ": " + why, item.error = error;
}

void leave_out(std::vector<PlanItem>& plan, const char* part, const std::string& why) {
    for (PlanItem& item : plan)
        if (item.part == part) item.done = false, item.why += ": " + why;
}

void bake_lightmap(SolvedDay& solved, const Progress& progress, Baked& baked) {
    LightmapRows rows = lightmap_rows(solved, {progress, SolvedDay::kShare, 0.9});
    EncodedLightmap encoded = encode_lightmap(std::move(rows.shape), rows.light(),
                                              {rows.tilts.row_of_texel, rows.tilts.rows}, rows.row_of_pixel, {});
    const std::string layout = solved.kept.note.empty() ? "" : solved.kept.note + "; ";
    note(baked.plan, "lightmap", layout + describe(encoded, solved.texels, solved.input.plan, solved.day, rows),
         encoded.error);
    baked.lightmap = std::move(encoded.map);
}

void bake_volume(const SolvedDay& solved, const Progress& progress, Baked& baked) {
    const BakeInput& input = solved.input;
    const LeavingLight leaving = solved.leaving();
    const LightBasis basis = light_basis(solved.day.basis);
    const VolumeEncoder encoder(input.scene, solved.reachable, solved.gather, solved.hits, basis, leaving,
                                solved.moments, input.plan.volume_settings,
                                {.dropped = kVolumeDropped * input.settings.error});
    EncodedVolume encoded = encoder.encode(input.plan.volume_settings, {progress, 0.9, 1.0});
    if (encoded.volume.tree.empty()) {
        leave_out(baked.plan, "volume", "but no free space is reached by cameras, things that move or open air");
        return;
    }
    note(baked.plan, "volume", describe(encoded, input.plan), encoded.error);
    baked.volume = std::move(encoded.volume);
}

}  // namespace

Baked bake(const Scene& scene, const BakeSettings& settings, const Progress& progress) {
    const BakeInput input(scene, settings);
    Baked baked;
    baked.light = settings.light, baked.unit = settings.unit, baked.lambert = settings.lambert;
    baked.geometry_hash = geometry_hash(input.mesh);
    baked.plan = input.plan.parts;
    if (!input.lit()) return baked;
    SolvedDay solved(input, progress);
    if (input.plan.lightmap) bake_lightmap(solved, progress, baked);
    solved.keep_for_probes();
    if (input.plan.volume) bake_volume(solved, progress, baked);
    return baked;
}

}  // namespace daylit
