// What the day lightmap's look-up, the relight pass and surfaces must agree on.
#ifndef SHADERS_SHARED_LIGHTMAP_H
#define SHADERS_SHARED_LIGHTMAP_H
#include "shaders/shared/brdf.h"
#include "shaders/shared/glsl.h"
SHARED_BEGIN

const int kLightmapTileSide = 16;  // texels that share their patterns, along either side of the atlas
const int kLightmapPatterns = 32;  // of a tile, at most; one number a texel (an RGB image has three)
const float kLightmapTiltScale = 4.0f;  // stored tilts times this are lux a radian: a normal map's slopes are small

// Irradiance when a normal map turns the normal: SH of two bands, written about the surface's own normal, where it is
// exact (three numbers a channel instead of four).
// irradiance      on the surface itself, lux
// tilt_u, tilt_v  its change as the normal leans towards u, v (rotation gradient, Ward and Heckbert 1992), lux a radian
// lean            the turned normal in the frame u, v, surface normal: unit, or shorter as the mean of several
// The cosine's share (1 + z) / 2 is that of light from all of the hemisphere alike.
SHARED_FN vec3 tilted_irradiance(vec3 irradiance, vec3 tilt_u, vec3 tilt_v, vec3 lean) {
    return max(irradiance * (0.5f + 0.5f * lean.z) + lean.x * tilt_u + lean.y * tilt_v, vec3(0.0f));
}

// The radiance that comes along a direction (its coordinates in that frame, unit) if radiance is linear in direction
// over the hemisphere, which irradiance and tilts determine: E = pi a, tilt = 2 pi / 3 b for L = a + b . direction.
// kept   of the linear part: 1, or less for the mean over a lobe
SHARED_FN vec3 tilted_radiance(vec3 irradiance, vec3 tilt_u, vec3 tilt_v, vec3 direction, float kept) {
    vec3 linear_part = 1.5f * kept * (direction.x * tilt_u + direction.y * tilt_v);
    return max(irradiance + linear_part, vec3(0.0f)) / kSharedPi;
}

SHARED_END
#endif
