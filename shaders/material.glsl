// A material at a point of a surface. The macros that stand for features are listed in README.md.
#include "shaders/shared/brdf.h"
#include "shaders/shared/frame_block.h"
layout(std140, binding = 1) uniform MaterialUniforms { MaterialBlock material; };

#ifdef BASE_COLOR_TEXTURE
layout(binding = 0) uniform sampler2D base_color_texture;
#endif
#ifdef METAL_ROUGH_TEXTURE
layout(binding = 1) uniform sampler2D metal_rough_texture;
#endif
#ifdef NORMAL_TEXTURE
layout(binding = 2) uniform sampler2D normal_texture;
#endif
#ifdef EMISSION_TEXTURE
layout(binding = 3) uniform sampler2D emission_texture;
#endif
#ifdef SPECULAR_TEXTURE
layout(binding = 12) uniform sampler2D specular_texture;
#endif
#ifdef SPECULAR_COLOR_TEXTURE
layout(binding = 13) uniform sampler2D specular_color_texture;
#endif
#ifdef TRANSMISSION_TEXTURE
layout(binding = 14) uniform sampler2D transmission_texture;
#endif

// uvs: both sets, in xy and zw. slot: 0 base, 1 metallic-roughness, 2 normal, 3 emission, 4 specular,
// 5 specular colour, 6 transmission.
vec2 texture_uv(int slot, vec4 uvs) {
#ifdef SECOND_UV
    vec2 uv = material.transforms[2 * slot].w > 0.5 ? uvs.zw : uvs.xy;
#else
    vec2 uv = uvs.xy;
#endif
#ifdef TEXTURE_TRANSFORM
    return vec2(dot(material.transforms[2 * slot].xyz, vec3(uv, 1.0)),
                dot(material.transforms[2 * slot + 1].xyz, vec3(uv, 1.0)));
#else
    return uv;
#endif
}

vec4 material_base_color(vec4 uvs, vec4 vertex_color) {
    vec4 color = material.base_color * vertex_color;
#ifdef BASE_COLOR_TEXTURE
    vec2 uv = texture_uv(0, uvs);
#ifdef MASK
    // Averaged alpha would fall below the cutoff and thin leaves and lattices away: holes are cut in the finest level.
    color *= vec4(texture(base_color_texture, uv).rgb, textureLod(base_color_texture, uv, 0.0).a);
#else
    color *= texture(base_color_texture, uv);
#endif
#endif
    return color;
}

vec3 material_emission(vec4 uvs) {
    vec3 emission = material.emission.rgb;
#ifdef EMISSION_TEXTURE
    emission *= texture(emission_texture, texture_uv(3, uvs)).rgb;
#endif
    return emission;
}

// Normal reflectance of the dielectric coat.
vec3 material_f0(vec4 uvs) {
    vec3 f0 = material.dielectric.rgb;
    float strength = material.dielectric.w;
#ifdef SPECULAR_COLOR_TEXTURE
    f0 *= texture(specular_color_texture, texture_uv(5, uvs)).rgb;
#endif
#ifdef SPECULAR_TEXTURE
    strength *= texture(specular_texture, texture_uv(4, uvs)).a;
#endif
    return min(f0, vec3(1.0)) * strength;
}

// Share that is smooth glass.
float material_transmission(vec4 uvs) {
    float transmission = material.metal_rough.w;
#ifdef TRANSMISSION_TEXTURE
    transmission *= texture(transmission_texture, texture_uv(6, uvs)).r;
#endif
    return transmission;
}

Brdf material_brdf(vec3 base_color, vec3 dielectric_f0, vec4 uvs) {
    float metallic = material.metal_rough.x;
    float roughness = material.metal_rough.y;
#ifdef METAL_ROUGH_TEXTURE
    vec3 metal_rough = texture(metal_rough_texture, texture_uv(1, uvs)).rgb;
    roughness *= metal_rough.g;
    metallic *= metal_rough.b;
#endif
    return brdf_from_metallic_roughness(base_color, metallic, roughness, dielectric_f0);
}

// n: the interpolated normal on the side that is seen; side: -1 on a back face, whose tangent frame is mirrored.
// evenness: length of the mean of the unit normals that the filter averaged; 1 where they all agree. Lambert's light of
// all of them together is that of their mean, so it is dimmed by this; a gloss lobe is widened (Toksvig 2005).
vec3 material_normal(vec3 n, float side, vec4 tangent, vec4 uvs, out float evenness) {
#ifdef NORMAL_TEXTURE
    vec3 t = texture(normal_texture, texture_uv(2, uvs)).rgb * 2.0 - 1.0;
    evenness = min(length(t) * 1.004, 1.0);  // 8 bits make a unit vector up to 0.4 % shorter
    t.xy *= material.metal_rough.z;
    vec3 outward = n * side;
    vec3 bitangent = cross(outward, tangent.xyz) * tangent.w;
    vec3 mapped = tangent.xyz * t.x + bitangent * t.y + outward * t.z;
    float size = dot(mapped, mapped);
    return size > 1.0e-8 ? mapped * (side * inversesqrt(size)) : n;
#else
    evenness = 1.0;
    return n;
#endif
}

float uneven_exponent(float exponent, float evenness) {
    return exponent * evenness / (evenness + exponent * (1.0 - evenness));
}
