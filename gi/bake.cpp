#include "gi/bake.h"

#include <bit>
#include <cstdio>

#include "engine/base/file.h"
#include "engine/base/random.h"
#include "gi/bake_plan.h"
#include "gi/encode/encode_lightmap.h"
#include "gi/encode/encode_volume.h"
#include "gi/surface/smooth.h"
#include "gi/surface/surroundings.h"
#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/texel_tilts.h"

namespace daylit {
namespace {

/// Texels whose front lies in the open.
std::vector<bool> in_the_open(const Texels& texels, const GatherHits& hits) {
    std::vector<bool> open(texels.count());
    for (std::size_t t = 0; t < open.size(); ++t) open[t] = !hits.buried(t);
    return open;
}

/// Texels whose own light is shown: those in the open, and, black, those so deep under other surfaces that nothing
/// visible is interpolated from them. The rest shows its nearest neighbour's.
std::vector<bool> shown(const Atlas& atlas, const Texels& texels, const GatherHits& hits,
                        const std::vector<bool>& open) {
    std::vector<bool> partly_open(texels.count());
    for (std::size_t t = 0; t < partly_open.size(); ++t) partly_open[t] = hits.usable[t] != 0;
    std::vector<bool> result = away_from(atlas, texels, partly_open);
    for (std::size_t t = 0; t < result.size(); ++t) result[t] = result[t] || open[t];
    return result;
}

std::string describe(const EncodedLightmap& encoded, const Texels& texels, const BakePlan& plan, const DaySolution& day,
                     const TexelTilts& tilts) {
    char error[32], patterns[160];
    std::snprintf(error, sizeof error, "%.4f", day.basis.error);
    std::snprintf(patterns, sizeof patterns,
                  "kept as %d keyframes and tiles of %.1f components (%d at most), worst tile's error %.3f",
                  int(encoded.map.basis.hours.size()), encoded.mean_patterns, encoded.map.slots(), encoded.worst_tile);
    return std::to_string(texels.count()) + " texels, " + std::to_string(plan.rays) + " rays each, " +
           std::to_string(plan.hours.size()) + " hours in " + std::to_string(day.basis.components) +
           " components (error " + error + "), " + std::to_string(day.bounces) + " bounces; " +
           (tilts.count() ? std::to_string(tilts.count()) + " texels under normal maps with tilts; " : "") + patterns;
}

std::vector<bool> both(std::vector<bool> a, const std::vector<bool>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] && b[i];
    return a;
}

/// Each texel that is shown is its own row.
std::vector<std::uint32_t> rows_of_texels(const std::vector<bool>& shown) {
    std::vector<std::uint32_t> result(shown.size(), ~0u);
    for (std::uint32_t t = 0; t < shown.size(); ++t)
        if (shown[t]) result[t] = t;
    return result;
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

/// Of all that decides what is traced.
std::uint64_t checkpoint_key(const Scene& scene, const WorldMesh& mesh, const BakePlan& plan,
                             const BakeSettings& settings) {
    constexpr std::uint64_t kStage = 2;  // changes whenever what is traced does
    std::uint64_t key = mix64(kStage ^ mix64(geometry_hash(mesh)));
    for (const std::uint64_t part :
         {std::uint64_t(plan.texel_budget), std::uint64_t(plan.rays), settings.seed, std::uint64_t(settings.lambert),
          std::uint64_t(settings.keep_uv2), std::bit_cast<std::uint64_t>(settings.unit)})
        key = mix64(key ^ part);
    if (std::filesystem::exists(scene.path)) {
        const std::vector<std::uint8_t> file = read_file(scene.path);
        key = hash_bytes(std::as_bytes(std::span(file)), key);
    }
    for (const Image8& image : scene.images) key = hash_bytes(std::as_bytes(std::span(image.rgba)), key);
    return key;
}

/// One solution for all parts: light at texels and probes at all hours, then a projection of it for each part.
void bake_light(const Scene& scene, const WorldMesh& mesh, std::span<const PlacedLight> lamps, const LightModel& light,
                const BakePlan& plan, const BakeSettings& settings, const Progress& progress, Baked& baked) {
    const RayScene rays(scene, mesh);
    const std::vector<Surroundings> around = look_around(rays, even_step(mesh, plan.texel_budget));
    const KeptLayouts kept = settings.keep_uv2 ? kept_layouts(scene, mesh) : KeptLayouts{};
    const Atlas atlas = make_atlas(mesh, plan.texel_budget, around, kept);
    const Texels texels = make_texels(mesh, atlas);
    const GatherScene gather = gather_scene(rays, atlas, texels, lamps);
    const GatherSettings how{.rays = plan.rays, .bounces = settings.bounces, .seed = settings.seed};

    Checkpoint checkpoint;
    if (!settings.checkpoint.empty())
        checkpoint = Checkpoint(settings.checkpoint, checkpoint_key(scene, mesh, plan, settings), settings.resume);
    const GatherHits hits = trace_hits(gather, how, checkpoint, {progress, 0.02, 0.42});
    const std::vector<ByLit> lamp_light = lamp_irradiance(gather, hits, how, {progress, 0.46, 0.5});
    DaySolution day = solve_day(gather, hits, lamp_light, day_light(light, plan.hours), how, {progress, 0.5, 0.85});
    if (plan.lightmap) {
        const std::vector<bool> open = in_the_open(texels, hits);
        const SmoothingWeights weights = smoothing_weights(rays, texels, hits.nearness, open);
        day.texels = smooth(weights, day.texels, day.basis.components);
        TexelTilts tilts;
        if (settings.directional) {
            tilts = texel_tilts(gather, hits, day, both(open, normal_mapped(gather)), how, {progress, 0.85, 0.9});
            smooth_tilts(gather, weights, day.basis.components, tilts);
        }
        DayLightmap shape;
        shape.width = atlas.width, shape.height = atlas.height, shape.corner_uvs = atlas.corner_uvs;
        const LightRows rows{light_basis(day.basis), 1, day.texels, moments(day, light)};
        EncodedLightmap encoded =
            encode_lightmap(std::move(shape), rows, {tilts.row_of_texel, tilts.rows},
                            rows_of_pixels(atlas, texels, rows_of_texels(shown(atlas, texels, hits, open))), {});
        const std::string layout = kept.note.empty() ? "" : kept.note + "; ";
        note(baked.plan, "lightmap", layout + describe(encoded, texels, plan, day, tilts), encoded.error);
        baked.lightmap = std::move(encoded.map);
    }
    if (plan.volume) {
        const LeavingLight leaving{day.basis.components, day.leaving, day.basis.component_of(StillPart::Lamps),
                                   day.basis.component_of(StillPart::Evening)};
        EncodedVolume encoded =
            encode_volume(scene, gather, hits, light_basis(day.basis), leaving, moments(day, light),
                          plan.volume_settings, {.dropped = 0.1 * settings.error}, {progress, 0.9, 1.0});
        if (encoded.volume.tree.empty()) {
            leave_out(baked.plan, "volume", "but no free space is reached by cameras, things that move or open air");
            return;
        }
        note(baked.plan, "volume", describe(encoded, plan), encoded.error);
        baked.volume = std::move(encoded.volume);
    }
}

}  // namespace

Baked bake(const Scene& scene, const BakeSettings& settings, const Progress& progress) {
    const Pose pose = pose_scene(scene);
    const WorldMesh mesh = world_mesh(scene, pose, Part::Static);
    const std::vector<PlacedLight> lamps = placed_lights(scene, pose);
    const LightModel light(settings.light, lamps);
    const BakePlan plan = plan_bake(scene_facts(scene), light, settings);

    Baked baked;
    baked.light = settings.light, baked.unit = settings.unit, baked.lambert = settings.lambert;
    baked.geometry_hash = geometry_hash(mesh);
    baked.plan = plan.parts;
    if (plan.lightmap || plan.volume) bake_light(scene, mesh, lamps, light, plan, settings, progress, baked);
    return baked;
}

}  // namespace daylit
