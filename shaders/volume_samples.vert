#version 450 core
// Samples of an irradiance volume as small spheres: over each a square that faces the eye.
#include "shaders/frame.glsl"

layout(std430, binding = 8) readonly buffer VolumeSamples { vec4 volume_samples[]; };  // centre, radius

layout(location = 0) out vec3 v_position;
layout(location = 1) flat out vec4 v_sphere;
layout(location = 2) flat out int v_record;

void main() {
    v_sphere = volume_samples[gl_InstanceID];
    v_record = gl_InstanceID;
    vec3 to_eye = frame.eye.w > 0.5 ? -frame.forward.xyz : normalize(frame.eye.xyz - v_sphere.xyz);
    vec3 right = normalize(cross(abs(to_eye.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), to_eye));
    vec2 at = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
    // Where the sphere is nearest to the eye, so that the square covers it whole.
    v_position = v_sphere.xyz + v_sphere.w * (to_eye + at.x * right + at.y * cross(to_eye, right));
    gl_Position = frame.clip_from_world * vec4(v_position, 1.0);
}
