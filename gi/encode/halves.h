#pragma once
// Component images as halves.
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/units.h"

namespace daylit {

/// What each component's values are to be divided by, so that the largest lies far from the end of halves; 1 for a
/// component that is zero everywhere. values: component running fastest.
std::vector<float> component_scales(std::span<const Rgb> values, int components);

/// value / scale, three halves each.
std::vector<std::uint16_t> to_halves(std::span<const Rgb> values, std::span<const float> scales);

}  // namespace daylit
