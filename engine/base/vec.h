#pragma once
// Unit vectors of numbers of any size.
#include "engine/base/units.h"

namespace daylit {

/// v at unit length, or `otherwise` when it has none. In double, since squares of very small and very large floats
/// leave a float's range.
inline Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
    const glm::dvec3 d(v);
    const double length = glm::length(d);
    return length > 1e-60 && length < 1e60 ? Vec3(d / length) : otherwise;
}

}  // namespace daylit
