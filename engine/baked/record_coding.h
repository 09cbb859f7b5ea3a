#pragma once
// Numbers of an irradiance volume's records as bytes that a general compressor makes much of.
#include "engine/baked/bytes.h"

namespace daylit {

/// Planes in threes, red, green and blue: [plane][channel][record]. Steps are by each channel's light, so that channels
/// hold much the same: red and blue are kept as what they differ from green, modulo the integer's range.
///
/// records   of each channel of a plane; numbers.size() is a multiple of three times as many
template <class Integer>
void put_planes(ByteWriter& w, std::span<const Integer> numbers, std::size_t records);
template <class Integer>
std::vector<Integer> get_planes(ByteReader& r, std::size_t count, std::size_t records);

}  // namespace daylit
