#pragma once
// 8-bit images as PNG bytes in memory.
#include <cstdint>
#include <vector>

namespace daylit::content {

/// channels: 3 (RGB) or 4 (RGBA); rows from the top, no padding.
std::vector<std::uint8_t> encode_png(int width, int height, int channels, const std::vector<std::uint8_t>& pixels);

}  // namespace daylit::content
