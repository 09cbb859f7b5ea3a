#include "gi/solved_day.h"

#include <algorithm>
#include <bit>
#include <optional>

#include "engine/base/file.h"
#include "engine/base/random.h"
#include "gi/encode/encode_lightmap.h"
#include "gi/surface/parting.h"
#include "gi/surface/smooth.h"
#include "gi/surface/surroundings.h"

namespace daylit {
namespace {

constexpr double kLeak = 0.1;  // of the brightness of a cell's brightest part, below which its darkest is shown alone

/// Of all that decides what is traced.
std::uint64_t checkpoint_key(const BakeInput& input) {
    constexpr std::uint64_t kStage = 3;  // changes whenever what is traced does
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

std::vector<bool> both(std::vector<bool> a, const std::vector<bool>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] && b[i];
    return a;
}

/// Brightness of a texel summed over the moments, each over what the eye is adapted to: linear, so that the moments'
/// weights are summed once.
class Brightness {
  public:
    explicit Brightness(const LightmapRows& rows)
        : rows_(rows), weights_(std::size_t(rows.basis.components), Rgb(0.0f)) {
        for (const Moment& m : rows.moments) {
            const std::vector<Rgb> of_moment = rows.basis.weights(m.scales, m.hour);
            for (std::size_t r = 0; r < weights_.size(); ++r) weights_[r] += of_moment[r] / float(m.exposure);
        }
    }
    double operator()(std::uint32_t texel) const {
        double sum = 0.0;
        for (std::size_t r = 0; r < weights_.size(); ++r)
            sum += double(luminance(weights_[r] * rows_.texels[texel * weights_.size() + r]));
        return sum;
    }

  private:
    const LightmapRows& rows_;
    std::vector<Rgb> weights_;  // per component
};

/// Of the parts of a cell that are shown, the darkest when the brightest is so much brighter that a mean would be light
/// through a wall: then the bright side is dark along the wall's foot. Not what is black and out of reach, as below the
/// ground.
std::optional<std::uint32_t> part_to_keep_dark(const SolvedDay& solved, const std::vector<std::uint32_t>& parts,
                                               const Brightness& brightness) {
    const auto darker = [&](std::uint32_t a, std::uint32_t b) { return brightness(a) < brightness(b); };
    const auto [darkest, brightest] = std::minmax_element(parts.begin(), parts.end(), darker);
    const double light = brightness(*darkest);
    if (light >= kLeak * brightness(*brightest)) return std::nullopt;
    if (light == 0.0 && !solved.reachable.space.reachable(solved.texels.above(*darkest))) return std::nullopt;
    return *darkest;
}

/// The mean over the usable points of parts becomes the first one's light.
void mix(const GatherHits& hits, const std::vector<std::uint32_t>& parts, std::size_t components,
         std::vector<Rgb>& rows) {
    std::vector<Rgb> sum(components, Rgb(0.0f));
    float points = 0.0f;
    for (const std::uint32_t part : parts) {
        const auto weight = float(std::popcount(hits.usable[part]));
        for (std::size_t r = 0; r < components; ++r) sum[r] += weight * rows[part * components + r];
        points += weight;
    }
    for (std::size_t r = 0; r < components; ++r) rows[parts[0] * components + r] = sum[r] / points;
}

/// Which row each texel shows, its own but where a cell has several parts.
std::vector<std::uint32_t> rows_of_texels(const SolvedDay& solved, const std::vector<bool>& shown, LightmapRows& rows) {
    const Brightness brightness(rows);
    std::vector<std::uint32_t> result(shown.size(), kNoTexel);
    for (std::uint32_t t = 0; t < shown.size(); ++t) {
        if (shown[t]) result[t] = t;
        const bool first = solved.texels.texel_of_cell[solved.texels.cell[t]] == t;
        if (!first || solved.texels.next_part[t] == kNoTexel) continue;
        std::vector<std::uint32_t> parts;
        solved.texels.for_parts(t, [&](std::uint32_t part) {
            if (!solved.hits.buried(part)) parts.push_back(part);
        });
        if (parts.empty()) continue;
        const std::optional<std::uint32_t> dark = part_to_keep_dark(solved, parts, brightness);
        if (!dark) mix(solved.hits, parts, solved.day.basis.components, rows.texels);
        result[t] = dark.value_or(parts[0]);
    }
    return result;
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
      day(solution_of(input, gather, hits, how, progress)) {}

LeavingLight SolvedDay::leaving() const {
    return {day.basis.components, day.leaving, day.basis.component_of(StillPart::Lamps),
            day.basis.component_of(StillPart::Evening)};
}

LightmapRows lightmap_rows(SolvedDay& solved, const StageProgress& progress) {
    const std::size_t components = solved.day.basis.components;
    const std::vector<bool> open = in_the_open(solved.texels, solved.hits);
    const SmoothingWeights weights = smoothing_weights(solved.rays, solved.texels, solved.hits.nearness, open);
    LightmapRows result;
    result.texels = std::move(solved.day.texels);
    smooth(weights, components, result.texels);
    if (solved.input.settings.directional) {
        result.tilts = texel_tilts(solved.gather, solved.hits, solved.day, both(open, normal_mapped(solved.gather)),
                                   solved.how, progress);
        smooth_tilts(solved.gather, weights, components, result.tilts);
    }
    result.shape.width = solved.atlas.width, result.shape.height = solved.atlas.height;
    result.shape.corner_uvs = solved.atlas.corner_uvs;
    result.basis = light_basis(solved.day.basis);
    result.moments = moments(solved.day, solved.input.light);
    result.row_of_pixel =
        rows_of_pixels(solved.atlas, solved.texels,
                       rows_of_texels(solved, shown(solved.atlas, solved.texels, solved.hits, open), result));
    return result;
}

}  // namespace daylit
