// Spherical harmonics of three bands: real, orthonormal, no Condon-Shortley sign, index l (l + 1) + m, over world axes
// with z as the pole (Sloan 2008, "Stupid spherical harmonics tricks", appendix A2, less the sign of odd m).
#ifndef SHADERS_SHARED_SH_H
#define SHADERS_SHARED_SH_H
#include "shaders/shared/glsl.h"
SHARED_BEGIN

const int kShCoefficients = 9;

struct Sh9 {
    float c[9];
};

// The basis functions in a unit direction.
SHARED_FN Sh9 sh_basis(vec3 d) {
    Sh9 y;
    y.c[0] = 0.282094792f;  // 1 / (2 sqrt(pi))
    y.c[1] = 0.488602512f * d.y;  // sqrt(3 / (4 pi))
    y.c[2] = 0.488602512f * d.z;
    y.c[3] = 0.488602512f * d.x;
    y.c[4] = 1.092548431f * d.x * d.y;  // sqrt(15 / (4 pi))
    y.c[5] = 1.092548431f * d.y * d.z;
    y.c[6] = 0.315391565f * (3.0f * d.z * d.z - 1.0f);  // sqrt(5 / (16 pi))
    y.c[7] = 1.092548431f * d.x * d.z;
    y.c[8] = 0.546274215f * (d.x * d.x - d.y * d.y);  // sqrt(15 / (16 pi))
    return y;
}

// The clamped cosine in bands 0, 1 and 2: pi, 2 pi / 3, pi / 4 (Ramamoorthi and Hanrahan 2001).
const float kShCosine0 = 3.14159265f, kShCosine1 = 2.09439510f, kShCosine2 = 0.785398163f;

// What the coefficients of radiance are multiplied by to give irradiance on a plane with this unit normal: the basis
// times the clamped cosine's bands (eq. 8).
SHARED_FN Sh9 sh_irradiance_weights(vec3 normal) {
    Sh9 w = sh_basis(normal);
    w.c[0] *= kShCosine0;
    for (int i = 1; i < 4; ++i) w.c[i] *= kShCosine1;
    for (int i = 4; i < 9; ++i) w.c[i] *= kShCosine2;
    return w;
}

// The same for the mean radiance over a Phong lobe of this exponent about a unit direction: its bands are 1,
// (n + 1) / (n + 2) and n / (n + 3).
SHARED_FN Sh9 sh_lobe_weights(vec3 direction, float exponent) {
    Sh9 w = sh_basis(direction);
    for (int i = 1; i < 4; ++i) w.c[i] *= (exponent + 1.0f) / (exponent + 2.0f);
    for (int i = 4; i < 9; ++i) w.c[i] *= exponent / (exponent + 3.0f);
    return w;
}

SHARED_END
#endif
