#include "gi/bake.h"

#include <bit>
#include <cstdio>

#include "engine/base/file.h"
#include "engine/base/random.h"
#include "gi/bake_plan.h"
#include "gi/encode/encode_lightmap.h"
#include "gi/encode/encode_volume.h"
#include "gi/surface/smooth.h"
#include "gi/transport/day_gather/day_gather.h"

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

std::string describe(const EncodedLightmap& encoded, const Texels& texels, const BakePlan& plan,
                     const DaySolution& day) {
    char error[32], patterns[160];
    std::snprintf(error, sizeof error, "%.4f", day.basis.error);
    std::snprintf(patterns, sizeof patterns,
                  "kept as %d keyframes and tiles of %.1f components (%d at most), worst tile's error %.3f",
                  int(encoded.map.basis.hours.size()), encoded.mean_patterns, encoded.map.slots(), encoded.worst_tile);
    return std::to_string(texels.count()) + " texels, " + std::to_string(plan.rays) + " rays each, " +
           std::to_string(plan.hours.size()) + " hours in " + std::to_string(day.basis.components) +
           " components (error " + error + "), " + std::to_string(day.bounces) + " bounces; " + patterns;
}

/// Each texel that is shown is its own row.
std::vector<std::uint32_t> rows_of_texels(const std::vector<bool>& shown) {
    std::vector<std::uint32_t> result(shown.size(), ~0u);
    for (std::uint32_t t = 0; t < shown.size(); ++t)
        if (shown[t]) result[t] = t;
    return result;
}

/// The hours that the file keeps: at most half an hour apart where hours are baked more closely.
std::vector<Keyframe> choose_keyframes(const LightModel& light, const std::vector<double>& hours) {
    constexpr double kApart = 0.5 - 1e-6;
    std::vector<Keyframe> result;
    for (std::size_t k = 0; k < hours.size(); ++k) {
        const bool next_is_late =
            k + 1 < hours.size() && !result.empty() && hours[k + 1] - hours[result.back().hour] > kApart + 2e-6;
        if (k > 0 && k + 1 < hours.size() && hours[k] - hours[result.back().hour] < kApart && !next_is_late) continue;
        result.push_back({k, light.scales(hours[k], light.settings().clouds)});
    }
    return result;
}

std::string describe(const EncodedVolume& encoded, const ProbeGrid& grid, const BakePlan& plan) {
    const auto& size = grid.size;
    char spacing[32];
    std::snprintf(spacing, sizeof spacing, "%.2f m", double(grid.spacing));
    return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]) + " probes " +
           spacing + " apart, " + std::to_string(grid.wanted.size()) + " where something can be, " +
           std::to_string(encoded.buried) + " of these in walls, " + std::to_string(plan.probe_rays) + " rays each, " +
           std::to_string(encoded.volume.basis.components) + " components";
}

std::vector<Vec3> wanted_positions(const ProbeGrid& grid) {
    std::vector<Vec3> positions;
    for (std::uint32_t probe : grid.wanted) positions.push_back(grid.position(probe));
    return positions;
}

/// Notes in the plan what a part came to.
void note(std::vector<PlanItem>& plan, const char* part, const std::string& why, double error) {
    for (PlanItem& item : plan)
        if (item.part == part) item.why += ": " + why, item.error = error;
}

/// Of all that decides what is traced.
std::uint64_t checkpoint_key(const Scene& scene, const WorldMesh& mesh, const BakePlan& plan,
                             const BakeSettings& settings) {
    constexpr std::uint64_t kStage = 1;  // changes whenever what is traced does
    std::uint64_t key = mix64(kStage ^ mix64(geometry_hash(mesh)));
    for (const std::uint64_t part : {std::uint64_t(plan.texel_budget), std::uint64_t(plan.rays), settings.seed,
                                     std::uint64_t(settings.lambert), std::bit_cast<std::uint64_t>(settings.unit)})
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
    const Atlas atlas = make_atlas(mesh, plan.texel_budget);
    const Texels texels = make_texels(mesh, atlas);
    const GatherScene gather = gather_scene(rays, atlas, texels, lamps);
    const GatherSettings how{.rays = plan.rays, .bounces = settings.bounces, .seed = settings.seed};
    const ProbeGrid grid = plan.volume ? make_probe_grid(scene, plan.probe_spacing, plan.most_probes) : ProbeGrid{};

    Checkpoint checkpoint;
    if (!settings.checkpoint.empty())
        checkpoint = Checkpoint(settings.checkpoint, checkpoint_key(scene, mesh, plan, settings), settings.resume);
    const GatherHits hits = trace_hits(gather, how, checkpoint, {progress, 0.02, 0.42});
    const ProbeHits probes =
        trace_probes(gather, hits, wanted_positions(grid), plan.probe_rays, how, {progress, 0.42, 0.46});
    const std::vector<ByLit> lamp_light = lamp_irradiance(gather, hits, how, {progress, 0.46, 0.5});
    DaySolution day = solve_day(gather, hits, lamp_light, day_light(light, plan.hours), how, {progress, 0.5, 0.95});
    const std::vector<Keyframe> keyframes = choose_keyframes(light, plan.hours);

    const TimeBasisSettings encoding{.error = plan.encoding_error};
    if (plan.lightmap) {
        const std::vector<bool> open = in_the_open(texels, hits);
        day.texels = smooth(smoothing_weights(rays, texels, hits.nearness, open), day.texels, day.basis.components);
        DayLightmap shape;
        shape.width = atlas.width, shape.height = atlas.height, shape.corner_uvs = atlas.corner_uvs;
        const LightRows rows{light_basis(day.basis), 1, day.texels, moments(day, light)};
        EncodedLightmap encoded =
            encode_lightmap(std::move(shape), rows,
                            rows_of_pixels(atlas, texels, rows_of_texels(shown(atlas, texels, hits, open))), {});
        note(baked.plan, "lightmap", describe(encoded, texels, plan, day), encoded.error);
        baked.lightmap = std::move(encoded.map);
    }
    if (plan.volume) {
        EncodedVolume encoded = encode_volume(grid, probes, day, keyframes, encoding);
        note(baked.plan, "volume", describe(encoded, grid, plan), encoded.error);
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
