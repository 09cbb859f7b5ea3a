#pragma once
// Environment images made usable. Internal to engine/scene and its tests; sky.h has the look-up.
#include <string>

#include "engine/scene/sky.h"

namespace daylit {

/// Brightest radiance an environment may hold, cd/m^2: six times the sun's disc, and its square is far from overflow.
inline constexpr float kBrightestEnvironment = 1e10f;

/// The image as an environment in cd/m^2, made finite and non-negative:
///   NaN and negative values  become 0, channel by channel (lossy compression makes slightly negative ones)
///   infinities               become the largest finite value of the image, at least 65504, the largest half float,
///                            since they come from half floats that overflowed
///   above 1e10               becomes 1e10
///   one channel              arrives here as grey already (read_image)
/// throws Error unless the image is twice as wide as high (one row or column of tolerance, for 1x1: a constant sky).
Environment usable_environment(Image image, const std::string& name);

/// Irradiance in lux that the map's upper half gives to level ground: exact for values constant over each texel.
Rgb horizontal_irradiance(const Environment& sky);

}  // namespace daylit
