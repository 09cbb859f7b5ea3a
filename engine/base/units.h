#pragma once
// What is true everywhere in daylit.
//
// Space       metres, right-handed, +Y up (as glTF). Without another north, north is -Z and east is +X.
// Transforms  target-from-source: clip_from_world * world_from_object * p_object.
// Directions  point away from the surface, towards the light. Normals are unit length.
// Light       radiometric names, photometric units, linear Rec. 709 RGB:
//             radiance L in cd/m^2, irradiance E in lux, radiosity B in lux, intensity I in cd.
//             Lambert: L = albedo * E / pi. A lightmap stores E, never E / pi.
// SH          real, orthonormal, no Condon-Shortley sign, index l(l+1)+m; 3 bands = 9 coefficients.
// Time        hours are local clock time in [0,24), a double, with the day's UTC offset.
// Angles      radians inside the code, degrees on the command line and in names that end in _deg.
// Faces       for light every face blocks and reflects on both sides; culling concerns only what the camera sees.
// Alpha       is coverage: MASK cuts, BLEND lets 1 - alpha straight through.

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace daylit {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;
using Quat = glm::quat;
using Rgb = glm::vec3;   // linear Rec. 709; the name beside it says which quantity
using Rgba = glm::vec4;  // linear Rec. 709 and coverage

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kDegree = kPi / 180.0;

// Angular radius of the sun's disc, for baker, reference and runtime alike.
inline constexpr double kSunRadius = 0.2665 * kDegree;

/// Luminance of a linear Rec. 709 triple (ITU-R BT.709), in the unit of its components.
inline float luminance(const Rgb& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }

}  // namespace daylit
