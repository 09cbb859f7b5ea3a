#version 450 core
// Depth of casters. MASK ones are cut. VEIL: the next BLEND caster behind the layers that are already known (depth
// peeling, Everitt 2001): its depth and the share of light that it lets through. CLUSTERS: the cluster that is seen.
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
layout(binding = 7) uniform sampler2DArray known_veils;
layout(location = 1) uniform int known_layer;  // the nearest layer known so far; -1: none
layout(location = 0) out vec2 out_veil;
#endif

#ifdef CLUSTERS
layout(location = 6) flat in uint v_cluster;
layout(location = 0) out uint out_cluster;
#endif

void main() {
#ifdef CLUSTERS
    out_cluster = v_cluster;
#endif
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
    if (known_layer >= 0 &&
        gl_FragCoord.z <= texelFetch(known_veils, ivec3(gl_FragCoord.xy, known_layer), 0).r + 1.0e-6) discard;
    out_veil = vec2(gl_FragCoord.z, 1.0 - alpha);
#else
    if (alpha < material.emission.w) discard;
#endif
#endif
}
