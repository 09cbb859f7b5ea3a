// The one BRDF of daylit, for baker, reference and shaders: Lambert plus energy-conserving normalised Phong,
//   f = diffuse / pi + specular (n + 2) / (2 pi) max(0, r.l)^n,     r = reflect(-view, normal),
// with diffuse + specular <= 1 per channel (Phong 1975; normalisation of Lafortune and Willems 1994, eq. 2-4).
// No Fresnel term: it keeps f reciprocal, and its lobe samplable exactly.
#ifndef SHADERS_SHARED_BRDF_H
#define SHADERS_SHARED_BRDF_H
#include "shaders/shared/glsl.h"
SHARED_BEGIN

struct Brdf {
    vec3 diffuse;    // albedo of the Lambert part
    vec3 specular;   // albedo of the Phong lobe at normal incidence
    float exponent;  // n of the Phong lobe, 0 to kMaxPhongExponent
};

// A lobe of this exponent is 0.26 degrees wide, no wider than the sun's disc: a mirror to the eye.
const float kMaxPhongExponent = 1.0e5f;
const float kSharedPi = 3.14159265358979f;

// glTF metallic-roughness to Lambert + Phong. The exponent is that of the half-vector lobe of equal width,
// 2 / alpha^2 - 2 with alpha = roughness^2 (Walter et al. 2007, section 5.3).
//   base_color          linear albedo
//   dielectric_f0       normal reflectance of the dielectric coat: ((ior - 1) / (ior + 1))^2 times the specular
//                       factor and colour of KHR_materials_specular, at most 1
SHARED_FN Brdf brdf_from_metallic_roughness(vec3 base_color, float metallic, float roughness, vec3 dielectric_f0) {
    float alpha = max(roughness * roughness, 1.0e-4f);
    float largest_f0 = max(dielectric_f0.x, max(dielectric_f0.y, dielectric_f0.z));
    Brdf brdf;
    brdf.diffuse = base_color * ((1.0f - metallic) * (1.0f - largest_f0));
    brdf.specular = mix(dielectric_f0, base_color, metallic);
    brdf.exponent = clamp(2.0f / (alpha * alpha) - 2.0f, 0.0f, kMaxPhongExponent);
    return brdf;
}

// f in 1/sr; cos_lobe = dot(reflect(-view, normal), light).
SHARED_FN vec3 evaluate_brdf(Brdf brdf, float cos_lobe) {
    // GLSL leaves pow(0, 0) undefined; the lobe of exponent 0 is 1 everywhere, as in C++.
    float lobe = (brdf.exponent + 2.0f) / (2.0f * kSharedPi) * pow(max(cos_lobe, 1.0e-30f), brdf.exponent);
    return brdf.diffuse / kSharedPi + brdf.specular * lobe;
}

// The share of light from all of the hemisphere alike that a Phong lobe of albedo 1 reflects towards a view, since the
// lobe of a low view is half below the horizon and its light comes in low: 1 along the normal, the view's cosine for
// narrow lobes. A soft maximum of cosine and 0, within 0.02 of quadrature for exponents from 0.5 on.
SHARED_FN float phong_softness(float exponent) {
    return 1.0f / (2.0f * exponent + 0.2f);
}
SHARED_FN float phong_directional_albedo(float exponent, float cos_view) {
    if (exponent <= 0.0f) return 1.0f;  // the lobe of exponent 0 is that of Lambert
    float q = phong_softness(exponent), c = max(cos_view, 0.0f);
    return (c + sqrt(c * c + q)) / (1.0f + sqrt(1.0f + q));
}
// Its mean over the hemisphere of views, cosine-weighted: what counts when light goes on from surface to surface.
SHARED_FN float phong_mean_albedo(float exponent) {
    if (exponent <= 0.0f) return 1.0f;
    float q = phong_softness(exponent), root = sqrt(1.0f + q);
    return 2.0f / 3.0f * (1.0f + root * root * root - q * sqrt(q)) / (1.0f + root);
}

SHARED_FN vec3 mean_albedo(Brdf brdf) {
    return brdf.diffuse + brdf.specular * phong_mean_albedo(brdf.exponent);
}

// The exponent of a Phong lobe seen under a uniform disc of the given angular radius: variances of the two narrow
// kernels add (2 / n for the lobe, radius^2 / 2 for the disc): 2 / (2 / n + radius^2 / 2), written so that n may be 0.
SHARED_FN float disc_widened_exponent(float exponent, float radius) {
    return exponent / (1.0f + 0.25f * exponent * radius * radius);
}

SHARED_END
#endif
