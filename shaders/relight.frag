#version 450 core
// This light's irradiance from the tile's patterns: one multiply-add a pattern and texel, only when the light changed.
// TILTED: also how it changes as the normal leans, for tiles under normal maps.
#include "shaders/shared/lightmap.h"
layout(binding = 0) uniform sampler2DArray values;  // four patterns a layer; behind all of them, tilts along u, along v
layout(std430, binding = 0) readonly buffer TileLight {
    vec4 light[];  // lux, kLightmapPatterns a tile; w of a tile's first: the layers that it uses
};
flat in uint v_tile;
layout(location = 0) out vec4 out_irradiance;
#ifdef TILTED
layout(location = 1) out vec4 out_tilt_u;
layout(location = 2) out vec4 out_tilt_v;
#endif

// Of the patterns of the tile, with a texel's numbers from layer `base` on.
vec3 pattern_sum(int base, int layers) {
    ivec2 at = ivec2(gl_FragCoord.xy);
    uint first = v_tile * uint(kLightmapPatterns);
    vec3 sum = vec3(0.0);
    for (int layer = 0; layer < layers; ++layer) {
        vec4 v = texelFetch(values, ivec3(at, base + layer), 0);
        uint p = first + 4u * uint(layer);
        sum += v.x * light[p].rgb + v.y * light[p + 1u].rgb + v.z * light[p + 2u].rgb + v.w * light[p + 3u].rgb;
    }
    return sum;
}

void main() {
    int layers = int(light[v_tile * uint(kLightmapPatterns)].w);
    out_irradiance = vec4(max(pattern_sum(0, layers), vec3(0.0)), 1.0);
#ifdef TILTED
    int all = textureSize(values, 0).z / 3;
    out_tilt_u = vec4(kLightmapTiltScale * pattern_sum(all, layers), 1.0);
    out_tilt_v = vec4(kLightmapTiltScale * pattern_sum(2 * all, layers), 1.0);
#endif
}
