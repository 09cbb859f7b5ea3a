#version 450 core
// Box filter from samples to pixels, in linear light as the reference's pixel filter.
layout(binding = 0) uniform sampler2D samples;
layout(location = 0) uniform int samples_per_side;
layout(location = 0) out vec4 out_light;

void main() {
    ivec2 from = ivec2(gl_FragCoord.xy) * samples_per_side;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < samples_per_side; ++y)
        for (int x = 0; x < samples_per_side; ++x) sum += texelFetch(samples, from + ivec2(x, y), 0).rgb;
    out_light = vec4(sum / float(samples_per_side * samples_per_side), 1.0);
}
