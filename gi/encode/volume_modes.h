#pragma once
// Ways to blend a cell's corners, for comparison: what the runtime uses is Adini alone. volume_mode_light.h looks light
// up in them.
#include <array>

#include "engine/base/units.h"

namespace daylit {

enum class VolumeBlend {
    Trilinear,  // values alone; second order
    Oat,        // trilinear mix of each corner's value + change * distance (Oat 2005); second order too
    Annen,      // the same extrapolations mixed by 1 / distance^b (Annen et al. 2004); second order
    Half,       // trilinear mix of value + half of change * distance; third order
    Adini       // glsl::volume_corner_weights(); fourth order
};
inline constexpr std::array<VolumeBlend, 5> kVolumeBlends = {VolumeBlend::Trilinear, VolumeBlend::Oat,
                                                             VolumeBlend::Annen, VolumeBlend::Half, VolumeBlend::Adini};
const char* name(VolumeBlend blend);

/// Annen's exponent b: larger ones favour the nearest corner more.
inline constexpr float kAnnenExponent = 4.0f;

/// How much each corner's value (x) and its change along x, y, z (yzw, metres) count at t in [0,1]^3 of a cell.
std::array<Vec4, 8> blend_weights(VolumeBlend blend, const Vec3& t, float side);

/// Its change, per metre, along an axis (0 to 2).
std::array<Vec4, 8> blend_weights_change(VolumeBlend blend, const Vec3& t, float side, int axis);

}  // namespace daylit
