#version 450 core
// This light's irradiance from the tile's patterns: one multiply-add a pattern and texel, only when the light changed.
#include "shaders/shared/lightmap.h"
layout(binding = 0) uniform sampler2DArray values;  // four patterns a layer
layout(std430, binding = 0) readonly buffer TileLight {
    vec4 light[];  // lux, kLightmapPatterns a tile; w of a tile's first: the layers that it uses
};
flat in uint v_tile;
layout(location = 0) out vec4 out_irradiance;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    uint first = v_tile * uint(kLightmapPatterns);
    int layers = int(light[first].w);
    vec3 sum = vec3(0.0);
    for (int layer = 0; layer < layers; ++layer) {
        vec4 v = texelFetch(values, ivec3(at, layer), 0);
        uint p = first + 4u * uint(layer);
        sum += v.x * light[p].rgb + v.y * light[p + 1u].rgb + v.z * light[p + 2u].rgb + v.w * light[p + 3u].rgb;
    }
    out_irradiance = vec4(max(sum, vec3(0.0)), 1.0);
}
