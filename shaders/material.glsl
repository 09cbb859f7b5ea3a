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

// uvs: both sets, in xy and zw. slot: 0 base, 1 metallic-roughness, 2 normal, 3 emission.
vec2 texture_uv(int slot, vec4 uvs) {
#ifdef SECOND_UV
    vec2 uv = material.uv_sets[slot] > 0.5 ? uvs.zw : uvs.xy;
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

Brdf material_brdf(vec3 base_color, vec4 uvs) {
    float metallic = material.metal_rough.x;
    float roughness = material.metal_rough.y;
#ifdef METAL_ROUGH_TEXTURE
    vec3 metal_rough = texture(metal_rough_texture, texture_uv(1, uvs)).rgb;
    roughness *= metal_rough.g;
    metallic *= metal_rough.b;
#endif
    return brdf_from_metallic_roughness(base_color, metallic, roughness, material.dielectric.rgb);
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
