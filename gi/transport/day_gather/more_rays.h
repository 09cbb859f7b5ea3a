#pragma once
// A last gather with more rays for the texels that are noisiest. What the bounces reflected is settled by then, so
// these rays need not be kept.
#include "gi/transport/day_gather/halved_light.h"
#include "gi/transport/day_gather/texel_noise.h"
#include "gi/transport/day_gather/texel_tilts.h"

namespace daylit {

/// Rays to add per texel, `mean` of all of them on average and at most `most` times those that it has: as many in all
/// as the noise of a texel asks for (its rays in proportion to the standard deviation of one ray, Neyman 1934), none
/// where the noise is below `target`.
/// wanted   per texel: somebody can look at it
std::vector<int> share_out_rays(const GatherHits& hits, std::span<const float> noise, const std::vector<bool>& wanted,
                                double mean, double target, double most);

/// Traces them and mixes them in, each ray of equal worth; `noise` becomes what is left.
/// texels   [texel][component], as DaySolution::texels
void gather_more(const GatherScene& scene, const GatherHits& hits, const DaySolution& day, const HalvedLight& light,
                 const GatherSettings& settings, std::span<const int> more, std::span<Rgb> texels, TexelTilts& tilts,
                 std::span<float> noise, const StageProgress& progress);

}  // namespace daylit
