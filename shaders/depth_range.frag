#version 450 core
// The pyramid of least and greatest depth (x, y) over blocks of a shadow map.
//   FROM_DEPTH   the finest level: blocks of 4 x 4 texels of the map
//   DILATE       what is read: the same level, each texel with its eight neighbours
//   neither      the next level: 2 x 2 of the one below
#ifdef FROM_DEPTH
layout(binding = 0) uniform sampler2DArray source_depth;
#else
layout(binding = 0) uniform sampler2DArray source_range;  // its base level is the one to read
#endif
layout(location = 0) uniform int layer;
layout(location = 0) out vec2 out_range;

void add(inout vec2 range, vec2 other) {
    range = vec2(min(range.x, other.x), max(range.y, other.y));
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 range = vec2(1.0, 0.0);
#if defined(FROM_DEPTH)
    vec2 texel = 1.0 / vec2(textureSize(source_depth, 0).xy);
    for (int y = 0; y < 4; y += 2)
        for (int x = 0; x < 4; x += 2) {
            vec4 z = textureGather(source_depth, vec3(vec2(4 * at + ivec2(x, y) + 1) * texel, float(layer)));
            add(range, vec2(min(min(z.x, z.y), min(z.z, z.w)), max(max(z.x, z.y), max(z.z, z.w))));
        }
#elif defined(DILATE)
    ivec2 last = textureSize(source_range, 0).xy - 1;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            add(range, texelFetch(source_range, ivec3(clamp(at + ivec2(x, y), ivec2(0), last), layer), 0).rg);
#else
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) add(range, texelFetch(source_range, ivec3(2 * at + ivec2(x, y), layer), 0).rg);
#endif
    out_range = range;
}
