#pragma once
// A LightBasis as part of a section (FORMAT.md, "A light basis").
#include "engine/baked/bytes.h"
#include "engine/baked/light_basis.h"

namespace daylit {

/// What is left of a basis in a file: curves are kept in 16 bits. Rounding what is rounded changes nothing.
LightBasis rounded(LightBasis basis);

void put_basis(ByteWriter& w, const LightBasis& basis);
LightBasis get_basis(ByteReader& r);

}  // namespace daylit
