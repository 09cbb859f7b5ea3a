#include "gi/solved_day.h"

#include <bit>

#include "engine/base/file.h"
#include "engine/base/random.h"
#include "gi/surface/parting.h"
#include "gi/surface/surroundings.h"

namespace daylit {
namespace {

/// Of all that decides what is traced.
std::uint64_t checkpoint_key(const BakeInput& input) {
    constexpr std::uint64_t kStage = 6;  // changes whenever what is traced does
    const BakeSettings& settings = input.settings;
    std::uint64_t key = mix64(kStage ^ mix64(geometry_hash(input.mesh)));
    for (const std::uint64_t part : {std::uint64_t(input.plan.texel_budget), std::uint64_t(input.plan.rays),
                                     settings.seed, std::uint64_t(settings.lambert), std::uint64_t(settings.keep_uv2),
                                     std::bit_cast<std::uint64_t>(settings.unit)})
        key = mix64(key ^ part);
    if (std::filesystem::exists(input.scene.path)) {
        const std::vector<std::uint8_t> file = read_file(input.scene.path);
        key = hash_bytes(std::as_bytes(std::span(file)), key);
    }
    for (const Image8& image : input.scene.images) key = hash_bytes(std::as_bytes(std::span(image.rgba)), key);
    return key;
}

Atlas atlas_of(const BakeInput& input, const RayScene& rays, const KeptLayouts& kept) {
    const std::vector<Surroundings> around = look_around(rays, even_step(input.mesh, input.plan.texel_budget));
    return make_atlas(input.mesh, input.plan.texel_budget, around, kept);
}

GatherHits hits_of(const BakeInput& input, const GatherScene& gather, const GatherSettings& how,
                   const Progress& progress) {
    Checkpoint checkpoint;
    if (!input.settings.checkpoint.empty())
        checkpoint = Checkpoint(input.settings.checkpoint, checkpoint_key(input), input.settings.resume);
    return trace_hits(gather, how, checkpoint, {progress, 0.02, 0.42});
}

DaySolution solution_of(const BakeInput& input, const GatherScene& gather, const GatherHits& hits,
                        const GatherSettings& how, const Progress& progress) {
    const std::vector<ByLit> lamp_light = lamp_irradiance(gather, hits, how, {progress, 0.46, 0.5});
    return solve_day(gather, hits, lamp_light, day_light(input.light, input.plan.hours), how,
                     {progress, 0.5, SolvedDay::kShare});
}

}  // namespace

BakeInput::BakeInput(const Scene& from, const BakeSettings& how)
    : scene(from),
      settings(how),
      mesh(world_mesh(scene, pose_scene(scene), Part::Static)),
      lamps(placed_lights(scene, pose_scene(scene))),
      light(settings.light, lamps),
      plan(plan_bake(scene_facts(scene), light, settings)) {}

SolvedDay::SolvedDay(const BakeInput& from, const Progress& progress)
    : input(from),
      how{.rays = input.plan.rays, .bounces = input.settings.bounces, .seed = input.settings.seed},
      rays(input.scene, input.mesh),
      reachable(input.scene, rays),
      kept(input.settings.keep_uv2 ? kept_layouts(input.scene, input.mesh) : KeptLayouts{}),
      atlas(atlas_of(input, rays, kept)),
      texels(make_parted_texels(rays, atlas)),
      gather(gather_scene(rays, atlas, texels, input.lamps)),
      hits(hits_of(input, gather, how, progress)),
      day(solution_of(input, gather, hits, how, progress)),
      moments(daylit::moments(day, input.light)) {}

LeavingLight SolvedDay::leaving() const {
    return {day.basis.components, day.leaving, day.basis.component_of(StillPart::Lamps),
            day.basis.component_of(StillPart::Evening)};
}

void SolvedDay::keep_for_probes() {
    hits.hit = {}, hits.emission = {}, hits.emission_tilts = {};
    day.texels = {};
}

}  // namespace daylit
