#pragma once
// Small integers as bytes that a general compressor makes much of: signs folded in, low bytes apart from high ones.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/baked/bytes.h"

namespace daylit {

void put_integers(ByteWriter& w, const std::vector<std::int16_t>& values);
std::vector<std::int16_t> get_integers(ByteReader& r, std::size_t count);

/// The same for integers most of which are 0, 1 or -1: two bits each, and bytes for what they cannot say. A general
/// compressor spends a bit on every byte at least.
void put_small_integers(ByteWriter& w, std::span<const std::int16_t> values);
std::vector<std::int16_t> get_small_integers(ByteReader& r, std::size_t count);

/// What a texel of a plane is expected to be from those left of it and above it in its tile (the median predictor of
/// Weinberger, Seroussi and Sapiro, LOCO-I, 2000). Tiles are squares of `side` texels from the plane's corner.
inline std::int16_t predicted_texel(const std::int16_t* plane, int width, int side, int x, int y) {
    const std::int16_t* at = plane + std::ptrdiff_t(y) * width + x;
    const bool has_left = x % side != 0, has_above = y % side != 0;
    if (!has_left) return has_above ? at[-width] : std::int16_t(0);
    const int left = at[-1];
    if (!has_above) return std::int16_t(left);
    const int above = at[-width], corner = at[-width - 1];
    return std::int16_t(std::clamp(left + above - corner, std::min(left, above), std::max(left, above)));
}

}  // namespace daylit
