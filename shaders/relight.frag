#version 450 core
// This hour's irradiance from the components of the day: one multiply-add a component and texel, only when the hour moved.
layout(binding = 0) uniform sampler2DArray components;
layout(std430, binding = 0) readonly buffer Weights { float weights[]; };  // one a component
layout(location = 0) out vec4 out_irradiance;

void main() {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < weights.length(); ++i)
        if (weights[i] != 0.0) sum += weights[i] * texelFetch(components, ivec3(ivec2(gl_FragCoord.xy), i), 0).rgb;
    out_irradiance = vec4(max(sum, vec3(0.0)), 1.0);
}
