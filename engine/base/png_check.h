#pragma once
// libpng speaks on stderr when a file is damaged; this finds the damage first.
#include <cstdint>
#include <span>
#include <string>

namespace daylit {

/// Empty for a PNG whose chunks are all there with the right check sums (PNG specification, section 5), else what is
/// wrong with it. Looks at the framing only, not at the compressed pixels.
std::string png_damage(std::span<const std::uint8_t> bytes);

}  // namespace daylit
