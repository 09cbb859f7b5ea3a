#version 450 core
// Depth only: the pre-pass, the suns' cascades and the lamps' maps.
layout(location = 0) in vec3 in_position;
layout(location = 0) uniform mat4 clip_from_world;
#ifdef TEXTURED
layout(location = 3) in vec4 in_uvs;
layout(location = 3) out vec4 v_uvs;
#endif
#ifdef VERTEX_COLOR
layout(location = 4) in vec4 in_color;
layout(location = 4) out vec4 v_color;
#endif

#ifdef CLUSTERS
layout(location = 6) in uint in_cluster;
layout(location = 6) flat out uint v_cluster;
#endif

invariant gl_Position;

void main() {
    gl_Position = clip_from_world * vec4(in_position, 1.0);
#ifdef TEXTURED
    v_uvs = in_uvs;
#endif
#ifdef VERTEX_COLOR
    v_color = in_color;
#endif
#ifdef CLUSTERS
    v_cluster = in_cluster;
#endif
}
