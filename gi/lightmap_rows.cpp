#include "gi/lightmap_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>

#include "gi/encode/encode_lightmap.h"
#include "gi/stitch.h"
#include "gi/surface/smooth.h"
#include "gi/transport/day_gather/more_rays.h"

namespace daylit {
namespace {

constexpr double kMostTimesRays = 8;  // a texel's first rays, that it may be given on top
constexpr float kNook = 0.5f;         // of a texel's width: mean distance of what is seen from a crack between things
constexpr double kLeak = 0.1;  // of the brightness of a cell's brightest part, below which its darkest is shown alone
// Of the brightness beside it, from which on a place under something is shown too: lit by as much, it is seen from as
// many places.
constexpr double kSeen = 0.5;

/// Texels whose front lies in the open.
std::vector<bool> in_the_open(const Texels& texels, const GatherHits& hits) {
    std::vector<bool> open(texels.count());
    for (std::size_t t = 0; t < open.size(); ++t) open[t] = !hits.buried(t);
    return open;
}

/// Of texels in the open, those that nothing lies on.
std::vector<bool> bare(const Texels& texels, std::vector<bool> open) {
    for (std::size_t t = 0; t < open.size(); ++t) open[t] = open[t] && !texels.covered[t];
    return open;
}

/// Of texels in the open, those under something, beside others of their chart that are not: hidden themselves, and what
/// is seen beside them is interpolated from them.
std::vector<bool> under_a_rim(const Atlas& atlas, const Texels& texels, const std::vector<bool>& open) {
    std::vector<bool> result = away_from(atlas, texels, bare(texels, open));
    for (std::size_t t = 0; t < result.size(); ++t) result[t] = open[t] && texels.covered[t] && !result[t];
    return result;
}

/// Texels whose own light is shown: those in the open, and, black, those so deep under other surfaces that nothing
/// visible is interpolated from them. The rest shows its nearest neighbour's.
std::vector<bool> shown(const Atlas& atlas, const Texels& texels, const GatherHits& hits,
                        const std::vector<bool>& open) {
    std::vector<bool> partly_open(texels.count());
    for (std::size_t t = 0; t < partly_open.size(); ++t) partly_open[t] = hits.usable[t] != 0;
    std::vector<bool> result = away_from(atlas, texels, partly_open);
    const std::vector<bool> rim = under_a_rim(atlas, texels, open);
    for (std::size_t t = 0; t < result.size(); ++t) result[t] = result[t] || (open[t] && !rim[t]);
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

/// Cells that show nothing of their own show the nearest bare texel beside them, not what lies as near but deeper under
/// what hides them; but those that are seen show their own.
/// row   per texel; those of hidden cells are changed
void show_bare_neighbours(const SolvedDay& solved, const std::vector<bool>& bare, const std::vector<bool>& open,
                          const Brightness& brightness, std::vector<std::uint32_t>& row) {
    const Texels& texels = solved.texels;
    const std::vector<std::uint32_t> own = row;
    for (const std::uint32_t t : texels.texel_of_cell) {
        if (t == kNoTexel || own[t] != kNoTexel) continue;
        float least = INFINITY;
        for_texels_around(solved.atlas, texels, t, 1, [&](std::uint32_t other) {
            if (own[other] == kNoTexel) return;
            texels.for_parts(other, [&](std::uint32_t part) {
                const float away = glm::distance(texels.position[part], texels.position[t]);
                if (bare[part] && away < least) least = away, row[t] = own[other];
            });
        });
        if (row[t] != kNoTexel && open[t] && brightness(t) >= kSeen * brightness(row[t])) row[t] = t;
    }
}

/// Of the parts of a cell that are shown, the darkest when the brightest is so much brighter that a mean would be light
/// through a wall: then the bright side is dark along the wall's foot. Not what is out of reach, as below the ground or
/// inside of masonry, where light comes but by seams.
std::optional<std::uint32_t> part_to_keep_dark(const SolvedDay& solved, const std::vector<std::uint32_t>& parts,
                                               const Brightness& brightness) {
    const auto darker = [&](std::uint32_t a, std::uint32_t b) { return brightness(a) < brightness(b); };
    const auto [darkest, brightest] = std::minmax_element(parts.begin(), parts.end(), darker);
    if (brightness(*darkest) >= kLeak * brightness(*brightest)) return std::nullopt;
    if (!solved.reachable.space.reachable(solved.texels.above(*darkest))) return std::nullopt;
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

/// The parts of a cell that are shown, without those that are black, and without nooks if there are others; after them
/// those under something that are seen.
std::vector<std::uint32_t> lit_parts(const SolvedDay& solved, const std::vector<bool>& shown,
                                     const Brightness& brightness, std::uint32_t first) {
    std::vector<std::uint32_t> parts;
    solved.texels.for_parts(first, [&](std::uint32_t part) {
        if (shown[part] && !solved.hits.buried(part)) parts.push_back(part);
    });
    const auto nook = [&](std::uint32_t part) {
        return solved.hits.nearness[part] < kNook * solved.texels.width[part];
    };
    if (!std::all_of(parts.begin(), parts.end(), nook)) std::erase_if(parts, nook);
    double brightest = 0.0;
    for (const std::uint32_t part : parts) brightest = std::max(brightest, brightness(part));
    if (brightest == 0.0) return parts;
    solved.texels.for_parts(first, [&](std::uint32_t part) {
        const bool hidden = !shown[part] && !solved.hits.buried(part);
        if (hidden && brightness(part) >= kSeen * brightest) parts.push_back(part);
    });
    return parts;
}

/// Which row each texel shows, its own but where a cell has several parts.
std::vector<std::uint32_t> rows_of_texels(const SolvedDay& solved, const std::vector<bool>& shown,
                                          const Brightness& brightness, LightmapRows& rows) {
    std::vector<std::uint32_t> result(shown.size(), kNoTexel);
    for (std::uint32_t t = 0; t < shown.size(); ++t) {
        if (shown[t]) result[t] = t;
        const bool first = solved.texels.texel_of_cell[solved.texels.cell[t]] == t;
        if (!first || solved.texels.next_part[t] == kNoTexel) continue;
        const std::vector<std::uint32_t> parts = lit_parts(solved, shown, brightness, t);
        if (parts.empty()) continue;
        const std::optional<std::uint32_t> dark = part_to_keep_dark(solved, parts, brightness);
        if (!dark) mix(solved.hits, parts, solved.day.basis.components, rows.texels);
        result[t] = dark.value_or(parts[0]);
    }
    return result;
}

/// The moments that noise is judged at, spread over the day, the night the last.
MomentLight moment_light(const LightmapRows& rows) {
    std::vector<std::vector<Rgb>> weights;
    const std::size_t hours = rows.basis.hours.size();
    for (std::size_t k = 0; k + 1 < kNoiseMoments; ++k) {
        const Moment& moment = rows.moments[(2 * k + 1) * hours / (2 * (kNoiseMoments - 1))];
        weights.push_back(rows.basis.weights(moment.scales, moment.hour));
    }
    weights.push_back(rows.basis.weights(rows.moments.back().scales, rows.moments.back().hour));
    return MomentLight(weights);
}

std::vector<int> rays_to_add(const SolvedDay& solved, std::span<const float> noise) {
    const double target = solved.input.settings.error;
    std::vector<bool> wanted(noise.size());
    for (std::uint32_t t = 0; t < wanted.size(); ++t)
        wanted[t] = double(noise[t]) > target && !solved.texels.covered[t] &&
                    solved.reachable.space.reachable(solved.texels.above(t));
    return share_out_rays(solved.hits, noise, wanted, solved.input.plan.more_rays, target, kMostTimesRays);
}

void smooth_all(const SolvedDay& solved, const std::vector<bool>& open, LightmapRows& rows) {
    const std::size_t components = solved.day.basis.components;
    const SmoothingWeights weights = smoothing_weights(solved.rays, solved.texels, solved.hits.nearness, open);
    smooth(weights, components, rows.texels);
    if (rows.tilts.count() > 0) smooth_tilts(solved.gather, weights, components, rows.tilts);
}

}  // namespace

LightmapRows lightmap_rows(SolvedDay& solved, const StageProgress& progress) {
    const std::vector<bool> open = in_the_open(solved.texels, solved.hits);
    LightmapRows result;
    result.moments = solved.moments;
    result.basis = light_basis(solved.day.basis);
    const HalvedLight light(solved.day);
    if (solved.input.settings.directional)
        result.tilts = texel_tilts(solved.gather, solved.hits, solved.day, light,
                                   both(open, normal_mapped(solved.gather)), solved.how, progress.part(0.0, 0.3));
    result.noise = texel_noise(solved.hits, solved.day, moment_light(result));
    result.texels = std::move(solved.day.texels);
    const std::vector<int> more = rays_to_add(solved, result.noise);
    result.more_rays = std::accumulate(more.begin(), more.end(), 0.0) / double(std::max<std::size_t>(more.size(), 1));
    gather_more(solved.gather, solved.hits, solved.day, light, solved.how, more, result.texels, result.tilts,
                result.noise, progress.part(0.3, 0.8));
    smooth_all(solved, open, result);
    result.shape.width = solved.atlas.width, result.shape.height = solved.atlas.height;
    result.shape.corner_uvs = solved.atlas.corner_uvs;
    const Brightness brightness(result);
    std::vector<std::uint32_t> row =
        rows_of_texels(solved, shown(solved.atlas, solved.texels, solved.hits, open), brightness, result);
    show_bare_neighbours(solved, bare(solved.texels, open), open, brightness, row);
    result.row_of_pixel = rows_of_pixels(solved.atlas, solved.texels, row);
    stitch_thin_charts(solved, open, row, result);
    return result;
}

}  // namespace daylit
