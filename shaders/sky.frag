#version 450 core
// The sky's map and the suns' discs, where no surface is.
#include "shaders/frame.glsl"
layout(binding = 9) uniform sampler2D sky_map;
layout(location = 0) in vec2 v_ndc;
layout(location = 0) out vec4 out_light;

const float kPi = 3.14159265358979;

// As Environment::radiance: latitude-longitude, row 0 at +Y, middle column along -Z.
vec3 sky_radiance(vec3 d) {
    vec2 uv = vec2(0.5 + atan(d.x, -d.z) / (2.0 * kPi), acos(clamp(d.y, -1.0, 1.0)) / kPi);
    return textureLod(sky_map, uv, 0.0).rgb;
}

vec3 discs(vec3 d) {
    vec3 sum = vec3(0.0);
#ifdef SUNS
    for (int i = 0; i < SUNS; ++i) {
        // The angle from the chord, which keeps its precision near zero.
        float angle = 2.0 * asin(min(0.5 * length(d - frame.suns[i].direction.xyz), 1.0));
        float cover = clamp(0.5 + (atan(frame.target.z) - angle) / frame.forward.w, 0.0, 1.0);
        sum += frame.suns[i].radiance.rgb * cover;
    }
#endif
    return sum;
}

void main() {
    vec3 d = frame.forward.xyz;
    if (frame.eye.w < 0.5) {
        vec4 p = frame.world_from_clip * vec4(v_ndc, 1.0, 1.0);  // a point on the near plane
        d = normalize(p.xyz / p.w - frame.eye.xyz);
    }
    out_light = vec4(sky_radiance(d) + discs(d), 1.0);
}
