#version 450 core
// Cuts MASK casters; veils BLEND ones: rgb is the share let through, multiplied up by blending, a the nearest depth.
#if defined(MASK) || defined(VEIL)
#include "shaders/material.glsl"
#endif
#ifdef TEXTURED
layout(location = 3) in vec4 v_uvs;
#endif
#ifdef VERTEX_COLOR
layout(location = 4) in vec4 v_color;
#endif
#ifdef VEIL
layout(location = 1) uniform float depth_scale;  // metres
layout(location = 0) out vec4 out_veil;
#endif

void main() {
#if defined(MASK) || defined(VEIL)
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
    float alpha = material_base_color(uvs, vertex_color).a;
#ifdef VEIL
    out_veil = vec4(vec3(1.0 - alpha), gl_FragCoord.z * depth_scale);
#else
    if (alpha < material.emission.w) discard;
#endif
#endif
}
