#pragma once
// Charts of a texel or a single row of them, as jugs, candles and mouldings have: plain, each would be seen as a patch.
#include "gi/lightmap_rows.h"

namespace daylit {

/// Gives each pixel of such charts a row of its own: light at its place and normal, from texels around on the same
/// smoothly shaded surface. Charts that meet there take the same along the edge that they share.
/// open   per texel: whether its front lies in the open
/// row    per texel: that it shows
void stitch_thin_charts(const SolvedDay& solved, const std::vector<bool>& open, std::span<const std::uint32_t> row,
                        LightmapRows& rows);

}  // namespace daylit
