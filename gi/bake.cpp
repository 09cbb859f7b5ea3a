#include "gi/bake.h"

#include <algorithm>

#include "gi/bake_plan.h"
#include "gi/encode/encode_lightmap.h"
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

std::string describe(const EncodedLightmap& encoded, const Texels& texels, const BakePlan& plan, int bounces) {
    return std::to_string(texels.count()) + " texels, " + std::to_string(plan.rays) + " rays each, " +
           std::to_string(plan.keyframes.hours.size()) + " keyframes in " + std::to_string(encoded.map.basis.components) +
           " components, " + std::to_string(bounces) + " bounces";
}

EncodedLightmap bake_lightmap(const Scene& scene, const WorldMesh& mesh, std::span<const PlacedLight> lamps,
                              const BakePlan& plan, const BakeSettings& settings, const Progress& progress,
                              std::string& why) {
    const RayScene rays(scene, mesh);
    const Atlas atlas = make_atlas(mesh, plan.texel_budget);
    const Texels texels = make_texels(mesh, atlas);
    const GatherScene gather = gather_scene(rays, atlas, texels, lamps);
    const GatherSettings how{.rays = plan.rays, .bounces = settings.bounces, .seed = settings.seed};

    const GatherHits hits = trace_hits(gather, how, {progress, 0.02, 0.45});
    const std::vector<Rgb> lamp_light = lamp_irradiance(gather, hits, how, {progress, 0.45, 0.5});
    DayIrradiance day = solve_day(gather, hits, lamp_light, plan.keyframes.lighting, how, {progress, 0.5, 0.95});

    const std::vector<bool> open = in_the_open(texels, hits);
    day.rows = smooth(smoothing_weights(rays, texels, hits.nearness, open), day.rows, day.columns);
    EncodedLightmap encoded = encode_lightmap(atlas, texels, day, plan.keyframes.hours, open, {.error = plan.encoding_error});
    why = describe(encoded, texels, plan, day.bounces);
    return encoded;
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
    if (plan.lightmap) {
        std::string why;
        EncodedLightmap encoded = bake_lightmap(scene, mesh, lamps, plan, settings, progress, why);
        baked.lightmap = std::move(encoded.map);
        for (PlanItem& item : baked.plan)
            if (item.part == "lightmap") item.why += ": " + why, item.error = encoded.error;
    }
    return baked;
}

}  // namespace daylit
