#pragma once
// A single moment of an uncompressed day, in the form that the runtime draws: what compressed days are compared with.
#include "gi/encode/encode_lightmap.h"

namespace daylit {

/// Every texel's light by three patterns that shine in one channel each, in 11 bits over a texel's own brightness; it
/// stays as it is whatever hour is asked for.
///
/// weights        of the rows' components at the moment
/// row_of_pixel   as encode_lightmap() takes it; so are map, rows and tilts
DayLightmap frame_lightmap(DayLightmap map, const LightRows& rows, const TiltRows& tilts,
                           std::span<const std::uint32_t> row_of_pixel, std::span<const Rgb> weights);

}  // namespace daylit
