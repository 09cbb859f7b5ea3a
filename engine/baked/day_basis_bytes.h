#pragma once
// A time basis as part of a section.
#include "engine/baked/bytes.h"
#include "engine/baked/day_basis.h"

namespace daylit {

inline constexpr std::uint32_t kMaxBasisComponents = 64, kMaxKeyframes = 4096;

/// Hours and curves; the numbers of both are written by the section.
void code_curves(const DayBasis& basis, ByteWriter& w);
/// basis.components is known already.
void decode_curves(ByteReader& r, std::size_t keyframes, DayBasis& basis);

/// Halves up to the end of the section. `what` they are, in an error.
std::vector<std::uint16_t> finite_halves(ByteReader& r, std::size_t count, const char* what);

}  // namespace daylit
