#version 450 core
// Exposure, the display curve and sRGB coding. Layers that are not light are shown as they are.
#include "shaders/shared/tonemap.h"
layout(binding = 0) uniform sampler2D light;
layout(location = 0) uniform float exposure;
layout(location = 0) in vec2 v_ndc;
layout(location = 0) out vec4 out_display;

vec3 encode_srgb(vec3 linear) {
    return mix(12.92 * linear, 1.055 * pow(max(linear, vec3(1.0e-8)), vec3(1.0 / 2.4)) - 0.055,
               greaterThan(linear, vec3(0.0031308)));
}

void main() {
    vec3 value = textureLod(light, v_ndc * 0.5 + 0.5, 0.0).rgb;
#ifdef AS_IS
    out_display = vec4(clamp(value * exposure, 0.0, 1.0), 1.0);
#else
    out_display = vec4(filmic(value * exposure), 1.0);
#endif
#ifdef ENCODE
    out_display.rgb = encode_srgb(out_display.rgb);
#endif
}
