#pragma once
// Noise filtering over neighbours in space, never across the atlas, so that charts that meet agree and walls separate.
#include <span>
#include <vector>

#include "gi/surface/texels.h"
#include "gi/trace/line_of_sight.h"

namespace daylit {

/// Weights of a texel's neighbours, itself included, summing to 1, some below 0; a sparse matrix by rows.
struct SmoothingWeights {
    std::vector<std::uint32_t> first;  // one more than texels
    std::vector<std::uint32_t> texel;
    std::vector<float> weight;
};

/// Neighbours on the same surface that see each other: within about two texels and a fifth of the distance to what
/// lights them (`nearness`, metres), facing alike, in one plane, with free sight just above the surface. Light that
/// changes evenly along the surface stays as it is, up to its rims.
///
/// usable    texels that hold light; the others get no neighbours and are nobody's
SmoothingWeights smoothing_weights(const RayScene& rays, const Texels& texels, std::span<const float> nearness,
                                   const std::vector<bool>& usable);

/// Above a texel's middle, and below what hangs over it: from where its neighbours are looked for.
Vec3 just_above(const Texels& texels, std::span<const float> nearness, std::uint32_t texel);

/// rows   texels * columns; smoothed in place, so many columns at a time, since a second copy of all would be what a
/// bake's
///        memory peaks at
void smooth(const SmoothingWeights& weights, std::size_t columns, std::vector<Rgb>& rows);
inline constexpr std::size_t kColumnsAtOnce = 8;

}  // namespace daylit
