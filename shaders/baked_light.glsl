// Baked indirect light for any program: include this, call BakedLight::bind(), pass the lightmap's uv.
#include "shaders/shared/lightmap.h"
layout(binding = 4) uniform sampler2D baked_irradiance_map;  // lux, this hour's

// Indirect irradiance in lux; radiance of a Lambert surface is albedo * this / pi.
vec3 baked_irradiance(vec2 lightmap_uv) {
    return texture(baked_irradiance_map, lightmap_uv).rgb;
}

#ifdef TILTED
layout(binding = 10) uniform sampler2D baked_tilt_u_map;  // lux a radian
layout(binding = 11) uniform sampler2D baked_tilt_v_map;

// Under normal maps: irradiance and tilts, with the surface's frame in the atlas.
struct TiltedLight {
    vec3 irradiance, tilt_u, tilt_v;
    mat3 world_from_frame;  // u, v, surface normal
};

// In uniform control flow, since it asks how place and coordinates change from pixel to pixel.
TiltedLight baked_tilted_light(vec2 lightmap_uv, vec3 place, vec3 surface_normal) {
    vec2 across = dFdx(lightmap_uv), down = dFdy(lightmap_uv);
    // The direction in which u alone grows, up to its length; none where coordinates stand still.
    vec3 u = (dFdx(place) * down.y - dFdy(place) * across.y) * sign(across.x * down.y - across.y * down.x);
    u -= dot(u, surface_normal) * surface_normal;
    float square = dot(u, u);
    u = square > 0.0 ? u * inversesqrt(square) : vec3(0.0);
    return TiltedLight(baked_irradiance(lightmap_uv), texture(baked_tilt_u_map, lightmap_uv).rgb,
                       texture(baked_tilt_v_map, lightmap_uv).rgb, mat3(u, cross(surface_normal, u), surface_normal));
}

// For the normal that the normal map says; shorter than 1 where it is the mean of several, since this is linear in it.
vec3 baked_irradiance(TiltedLight light, vec3 normal) {
    return tilted_irradiance(light.irradiance, light.tilt_u, light.tilt_v, normal * light.world_from_frame);
}

// The mean radiance that a Phong lobe meets about a unit direction.
vec3 baked_radiance(TiltedLight light, vec3 direction, float exponent) {
    return tilted_radiance(light.irradiance, light.tilt_u, light.tilt_v, direction * light.world_from_frame,
                           (exponent + 1.0) / (exponent + 2.0));
}
#endif
