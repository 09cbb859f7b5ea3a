#pragma once
// Floats at half their bytes.
#include <bit>
#include <cstdint>

namespace daylit {

/// The upper half of a float, rounded: rows at half the bytes, with a float's range. Rounding, 0.2 % at most, averages
/// out over a receiver's rays.
inline std::uint16_t to_bfloat(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    return std::uint16_t((bits + 0x7FFFu + (bits >> 16 & 1u)) >> 16);
}
inline float from_bfloat(std::uint16_t value) {
    return std::bit_cast<float>(std::uint32_t(value) << 16);
}

}  // namespace daylit
