#version 450 core
// One square a tile of the lightmap.
#include "shaders/shared/lightmap.h"
layout(binding = 0) uniform sampler2DArray values;
layout(std430, binding = 1) readonly buffer Tiles { uint tiles[]; };
layout(location = 0) uniform uint first_tile;
flat out uint v_tile;

void main() {
    v_tile = tiles[first_tile + uint(gl_InstanceID)];
    ivec2 size = textureSize(values, 0).xy;
    uint across = uint(size.x + kLightmapTileSide - 1) / uint(kLightmapTileSide);
    vec2 corner = vec2(v_tile % across, v_tile / across) + vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(2.0 * corner * float(kLightmapTileSide) / vec2(size) - 1.0, 0.0, 1.0);
}
