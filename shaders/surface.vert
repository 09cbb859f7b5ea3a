#version 450 core
// World-space triangles to the screen, with the attributes that the program's features need.
#include "shaders/frame.glsl"
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec4 in_uvs;
layout(location = 4) in vec4 in_color;
layout(location = 5) in vec2 in_lightmap_uv;
layout(location = 7) in vec3 in_volume_front;  // indirect irradiance on the two sides
layout(location = 8) in vec3 in_volume_back;

layout(location = 0) out vec3 v_position;
layout(location = 1) out vec3 v_normal;
#ifdef NORMAL_TEXTURE
layout(location = 2) out vec4 v_tangent;
#endif
#ifdef TEXTURED
layout(location = 3) out vec4 v_uvs;
#endif
#ifdef VERTEX_COLOR
layout(location = 4) out vec4 v_color;
#endif
#ifdef LIGHTMAP
layout(location = 5) out vec2 v_lightmap_uv;
#endif
#if defined(VOLUME) && !defined(VOLUME_PIXEL)
layout(location = 6) out vec3 v_volume_front;
layout(location = 7) out vec3 v_volume_back;
#endif

invariant gl_Position;  // the depth pre-pass computes the same

void main() {
    gl_Position = frame.clip_from_world * vec4(in_position, 1.0);
    v_position = in_position;
    v_normal = in_normal;
#ifdef NORMAL_TEXTURE
    v_tangent = in_tangent;
#endif
#ifdef TEXTURED
    v_uvs = in_uvs;
#endif
#ifdef VERTEX_COLOR
    v_color = in_color;
#endif
#ifdef LIGHTMAP
    v_lightmap_uv = in_lightmap_uv;
#endif
#if defined(VOLUME) && !defined(VOLUME_PIXEL)
    v_volume_front = in_volume_front;
    v_volume_back = in_volume_back;
#endif
}
