#version 450 core
// A sample's irradiance on every side, as on a white sphere.
#include "shaders/frame.glsl"
#include "shaders/baked_volume.glsl"

layout(location = 0) in vec3 v_position;
layout(location = 1) flat in vec4 v_sphere;
layout(location = 2) flat in int v_record;

layout(location = 0) out vec4 out_light;

void main() {
    vec3 along = frame.eye.w > 0.5 ? frame.forward.xyz : normalize(v_position - frame.eye.xyz);
    vec3 from = v_position - v_sphere.xyz;
    float b = dot(from, along), inside = b * b - dot(from, from) + v_sphere.w * v_sphere.w;
    if (inside < 0.0) discard;
    vec3 hit = v_position - (b + sqrt(inside)) * along;
    vec4 clip = frame.clip_from_world * vec4(hit, 1.0);
    gl_FragDepth = clip.z / clip.w;

    VolumeSh sh;
    for (int i = 0; i < kShCoefficients; ++i)
        for (int channel = 0; channel < 3; ++channel)
            sh.c[i][channel] = volume_records[kVolumeNumbers * v_record + 3 * i + channel].x;
    out_light = vec4(volume_irradiance(sh, (hit - v_sphere.xyz) / v_sphere.w, 1.0) * LIGHT_SHOWN, 1.0);
}
