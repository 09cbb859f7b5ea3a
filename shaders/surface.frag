#version 450 core
// Light that a surface sends to the camera: emission, suns, lamps and baked indirect light, or one layer alone.
#include "shaders/frame.glsl"
#include "shaders/material.glsl"
#ifdef SUNS
#include "shaders/sun_visibility.glsl"
#endif
#ifdef LAMPS
#include "shaders/lamps.glsl"
layout(location = 10) uniform uvec4 lamp_bits;  // the lamps that may light what is drawn, one or more
#endif
#ifdef LIGHTMAP
#include "shaders/baked_light.glsl"
#endif

layout(location = 0) in vec3 v_position;
layout(location = 1) in vec3 v_normal;
#ifdef NORMAL_TEXTURE
layout(location = 2) in vec4 v_tangent;
#endif
#ifdef TEXTURED
layout(location = 3) in vec4 v_uvs;
#endif
#ifdef VERTEX_COLOR
layout(location = 4) in vec4 v_color;
#endif
#ifdef LIGHTMAP
layout(location = 5) in vec2 v_lightmap_uv;
#endif
#ifdef VOLUME_PIXEL
#include "shaders/baked_volume.glsl"
#elif defined(VOLUME)
layout(location = 6) in vec3 v_volume_front;
layout(location = 7) in vec3 v_volume_back;
#endif

// Dual-source: the target becomes out_light + out_through * target in the blended pass.
layout(location = 0, index = 0) out vec4 out_light;
#ifdef THROUGH
layout(location = 0, index = 1) out vec4 out_through;
#endif

// Irradiance in lux that arrives straight, and the radiance that leaves because of it.
struct Light {
    vec3 irradiance;
    vec3 radiance;
};

void add_light(inout Light light, Brdf brdf, vec3 facing_irradiance, vec3 to_light, vec3 normal, vec3 mirrored) {
    vec3 e = facing_irradiance * max(dot(normal, to_light), 0.0);
    light.irradiance += e;
    light.radiance += e * evaluate_brdf(brdf, dot(mirrored, to_light));
}

Light direct_light(Brdf brdf, vec3 normal, vec3 face_normal, vec3 view) {
    Light light = Light(vec3(0.0), vec3(0.0));
    vec3 mirrored = reflect(-view, normal);
    // Both loops ask at their end, and never for less than one light: a software driver runs a loop's body once more after
    // the last pixel has left it.
#ifdef SUNS
    Brdf under_disc = brdf;
    under_disc.exponent = disc_widened_exponent(brdf.exponent, frame.target.z);
    int sun = 0;
    do {
        vec3 to_sun = frame.suns[sun].direction.xyz;
        if (dot(normal, to_sun) > 0.0) {
            float seen = sun_visibility(sun, v_position, face_normal);
            add_light(light, under_disc, frame.suns[sun].irradiance.rgb * seen, to_sun, normal, mirrored);
        }
    } while (++sun < SUNS);
#endif
#ifdef LAMPS
    uvec4 left = lamp_bits;
    do {
        int lamp = take_lamp(left);
        vec3 to_lamp = lamp_block.lamps[lamp].position.xyz - v_position;
        vec3 e = lamp_irradiance(lamp, to_lamp) * lamp_visibility(lamp, to_lamp, face_normal);
        add_light(light, brdf, e, normalize(to_lamp), normal, mirrored);
    } while (any_lamp(left));
#endif
    return light;
}

void main() {
#ifdef TEXTURED
    vec4 uvs = v_uvs;
#else
    vec4 uvs = vec4(0.0);
#endif
#ifdef VERTEX_COLOR
    vec4 vertex_color = v_color;
#else
    vec4 vertex_color = vec4(1.0);
#endif
    vec4 base_color = material_base_color(uvs, vertex_color);
#ifdef MASK
    if (base_color.a < material.emission.w) discard;
#endif

    // The face's own plane, exact also where normals are smoothed; both normals turned to the side that is seen.
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 view = frame.eye.w > 0.5 ? -frame.forward.xyz : normalize(frame.eye.xyz - v_position);
    vec3 face_normal = cross(dFdx(v_position), dFdy(v_position));
    face_normal *= inversesqrt(max(dot(face_normal, face_normal), 1.0e-30));
    if (dot(face_normal, view) < 0.0) face_normal = -face_normal;
    vec3 normal = normalize(v_normal) * side;
    float evenness = 1.0;
#ifdef NORMAL_TEXTURE
    normal = material_normal(normal, side, v_tangent, uvs, evenness);
#endif

    vec3 dielectric_f0 = material_f0(uvs);
    Brdf brdf = material_brdf(base_color.rgb, dielectric_f0, uvs);
#ifdef NORMAL_TEXTURE
    brdf.exponent = uneven_exponent(brdf.exponent, evenness);
#endif
    vec3 emission = material_emission(uvs);
#ifdef UNLIT
    brdf.diffuse = vec3(0.0);
    brdf.specular = vec3(0.0);
    emission = base_color.rgb;
#endif

    float cover = 1.0;
#ifdef THROUGH
    vec3 through = vec3(0.0);
#ifdef GLASS
    // Smooth glass: what lies behind comes straight through, tinted, less Fresnel's share (Schlick 1994). By the share
    // that is glass, which the reference meets by that chance: the rest reflects as any surface. Gloss is whole, since
    // both have the coat; shadow maps take both for opaque, as the reference's shadow rays do.
    float transmission = material_transmission(uvs);
    float f0 = max(dielectric_f0.r, max(dielectric_f0.g, dielectric_f0.b));
    float fresnel = f0 + (1.0 - f0) * pow(1.0 - abs(dot(normal, view)), 5.0);
    through = base_color.rgb * (transmission * (1.0 - fresnel));
    brdf.diffuse *= 1.0 - transmission;
#endif
#ifdef BLEND
    cover = base_color.a;
    through = through * cover + vec3(1.0 - cover);
#endif
    out_through = vec4(through, 0.0);
#endif

#if defined(SHOW_ALBEDO)
    out_light = vec4((brdf.diffuse + brdf.specular) * cover, 1.0);
#elif defined(SHOW_NORMAL)
    out_light = vec4((normal * 0.5 + 0.5) * cover, 1.0);
#elif defined(SHOW_DEPTH)
    float depth = frame.eye.w > 0.5 ? dot(v_position - frame.eye.xyz, frame.forward.xyz)
                                    : length(v_position - frame.eye.xyz);
    out_light = vec4(vec3(depth) * cover, 1.0);
#else
    Light direct = Light(vec3(0.0), vec3(0.0));
    vec3 indirect = vec3(0.0);  // irradiance
    vec3 mirrored = vec3(0.0);  // radiance about the mirrored view
#if defined(SHOW_FINAL) || defined(SHOW_DIRECT) || defined(SHOW_IRRADIANCE)
    direct = direct_light(brdf, normal, face_normal, view);
    direct.irradiance *= evenness;
    direct.radiance *= evenness;
#endif
#if defined(LIGHTMAP) && (defined(SHOW_FINAL) || defined(SHOW_INDIRECT) || defined(SHOW_IRRADIANCE) || defined(SHOW_LIGHTMAP))
#if defined(TILTED) && defined(NORMAL_TEXTURE)
    TiltedLight baked = baked_tilted_light(v_lightmap_uv, v_position, normalize(v_normal));
    indirect = baked_irradiance(baked, normal * (side * evenness));
    mirrored = baked_radiance(baked, reflect(-view, normal) * side, brdf.exponent);
#else
    indirect = baked_irradiance(v_lightmap_uv);
    mirrored = indirect / kSharedPi;
#endif
#endif
#if defined(VOLUME) && (defined(SHOW_FINAL) || defined(SHOW_INDIRECT) || defined(SHOW_IRRADIANCE) || defined(SHOW_VOLUME))
#ifdef VOLUME_PIXEL
    VolumeSh around = volume_sh(volume_place(v_position));
    indirect = volume_irradiance(around, normal, 1.0);
    mirrored = volume_radiance(around, reflect(-view, normal), brdf.exponent);
#else
    indirect = gl_FrontFacing ? v_volume_front : v_volume_back;
    mirrored = indirect / kSharedPi;
#endif
#endif
#if defined(SHOW_IRRADIANCE) || defined(SHOW_LIGHTMAP) || defined(SHOW_VOLUME)
    out_light = vec4((direct.irradiance + indirect) * cover, 1.0);
#else
    // The gloss of indirect light in its rough first form: what is known of it changes slowly with direction.
    float gloss = phong_directional_albedo(brdf.exponent, dot(normal, view));
    vec3 radiance = direct.radiance + indirect * brdf.diffuse / kSharedPi + mirrored * brdf.specular * gloss;
#if defined(SHOW_FINAL) || defined(SHOW_DIRECT)
    radiance += emission;
#endif
    out_light = vec4(radiance * cover, 1.0);
#endif
#endif
}
