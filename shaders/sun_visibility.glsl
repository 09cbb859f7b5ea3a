// Share of a sun's disc that a point sees, from the cascades of shadow maps.
//
// Most pixels lie nowhere near a penumbra. A pyramid of the least and greatest depth (sun_range) bounds the height of
// any blocker above the point, hence how far sideways it can stand and still cover part of the disc; a few steps down
// the pyramid shrink that reach until it is below a texel, or the whole reach is covered. Only what is left is filtered
// with many taps: blocker search and filter of Fernando 2005, but the kernel is the true disc, and only blockers inside
// the cone towards the disc count.
//
// Depths are compared with the receiver's own plane at the very texel that was fetched, so no slope bias is needed.
layout(binding = 5) uniform sampler2DArray sun_depth;  // nearest, share of the depth range
layout(binding = 6) uniform sampler2DArray sun_range;  // mip k: least, greatest over a block of 4 * 2^k and its neighbours
#ifdef BLEND_CASTERS
// BLEND casters in the order of their depth: depth and share let through; kVeils layers for each layer of sun_depth.
layout(binding = 7) uniform sampler2DArray sun_veils;
const int kVeils = BLEND_CASTERS;
#endif

// Of the receiver's plane with the sun, as a cosine: over a texel a steeper plane would pass below what stands a metre above
// it, and bumps on a wall that the sun grazes would catch its light through the vault.
const float kLeastFacing = 0.07;

struct SunReceiver {
    vec2 texel;     // in texels of the map
    float depth;    // metres
    vec2 gradient;  // of the receiver's plane: metres of depth per texel
    float size;     // texel in metres
    float scale;    // metres of the stored range
    int layer;
};

// Metres that the maps' blockers stand above the receiver's plane, in the four texels around a place; f: where between them.
vec4 heights_around(SunReceiver r, vec2 offset, out vec2 f) {
    vec2 place = r.texel + offset;
    vec2 base = floor(place - 0.5);
    f = place - 0.5 - base;
    vec4 z = textureGather(sun_depth, vec3((base + 1.0) / frame.counts.z, float(r.layer))) * r.scale;
    vec4 dx = vec4(0.0, 1.0, 1.0, 0.0) - f.x + offset.x;
    vec4 dy = vec4(1.0, 1.0, 0.0, 0.0) - f.y + offset.y;
    return r.depth + r.gradient.x * dx + r.gradient.y * dy - z;
}

float between_texels(vec4 v, vec2 f) {
    vec2 rows = mix(v.wx, v.zy, f.x);
    return mix(rows.x, rows.y, f.y);
}

// Lit share of the four texels around a place, bilinear; depth is the plane's at that place.
float lit_bilinear(SunReceiver r, vec2 offset, float slack) {
    vec2 f;
    vec4 height = heights_around(r, offset, f);
    return between_texels(step(height, vec4(slack)), f);
}

// Share of the point's own four texels whose blockers stand so low that their penumbra is narrower than a texel: past them
// nothing comes, wherever the taps of a far blocker's wide kernel fall.
float shut_share(SunReceiver r, float slack, float low) {
    vec2 f;
    vec4 height = heights_around(r, vec2(0.0), f);
    return between_texels(step(vec4(slack), height) * step(height, vec4(low)), f);
}

// Interleaved gradient noise (Jimenez 2014): neighbouring pixels turn the taps differently.
float tap_rotation() {
    return 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}

// Taps lie on Vogel's spiral, points of equal area on a disc: each is turned by the golden angle from the one before.
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

// taps is 0 outside of penumbras, where one bilinear comparison says all. Software drivers run both sides of every `if` but
// leave a loop at its end when no pixel of a group goes on, so the loops themselves are what skips the work; a constant
// count would be unrolled and always paid. They ask at their end, since asking at the start costs one more turn.
float lit_share(SunReceiver r, float reach, float slack, int taps) {
    float turn = tap_rotation();
    vec2 first = vec2(cos(turn), sin(turn));
    float spread = frame.target.z / r.size;  // texels of disc radius per metre of height
    float heights = 0.0, blockers = 0.0;
    vec2 direction = first;
    int tap = 0;
    do {
        ivec2 at = ivec2(r.texel + direction * (reach * sqrt((float(tap) + 0.5) / float(max(taps, 1)))));
        direction = kGoldenTurn * direction;
        vec2 offset = vec2(at) + 0.5 - r.texel;
        float z = texelFetch(sun_depth, ivec3(at, r.layer), 0).r * r.scale;
        float height = r.depth + dot(r.gradient, offset) - z;
        if (tap < taps && height > slack && length(offset) - 1.0 <= spread * height) {
            heights += height;
            blockers += 1.0;
        }
    } while (++tap < taps);
    float radius = 0.0;
    if (blockers > 0.0) radius = max(spread * heights / blockers, 0.5);
    int count = blockers > 0.0 ? taps : 1;
    float lit = 0.0;
    direction = first;
    tap = 0;
    do {
        lit += lit_bilinear(r, direction * (radius * sqrt((float(tap) + 0.5) / float(count))), slack);
        direction = kGoldenTurn * direction;
    } while (++tap < count);
    lit /= float(count);
    return blockers > 0.0 ? lit * (1.0 - shut_share(r, slack, 0.5 / spread)) : lit;
}

// position: world; normal: of the face, turned to the side that is seen. Zero when that side turns away from the sun.
float sun_visibility(int sun, vec3 position, vec3 normal) {
    float facing = dot(normal, frame.suns[sun].direction.xyz);
    if (facing <= 0.0) return 0.0;
    vec2 across = vec2(dot(frame.suns[sun].axis_x.xyz, position), dot(frame.suns[sun].axis_y.xyz, position));
    // Constant indices only: software drivers fetch a uniform at a varying index lane by lane, at ten times the cost.
    vec4 cascade = vec4(0.0);
    int layer = -1;
    for (int c = kMaxCascades - 1; c >= 0; --c) {
        vec4 other = frame.cascades[sun * kMaxCascades + c];  // width 0 beyond the last
        vec2 away = abs(across - other.xy);
        if (max(away.x, away.y) < other.w) {
            cascade = other;
            layer = c;
        }
    }
    if (layer < 0) return 1.0;

    SunReceiver r;
    r.layer = int(frame.suns[sun].axis_x.w) + layer;
    r.size = cascade.z;
    r.scale = frame.suns[sun].irradiance.w;
    r.texel = (across - cascade.xy) / r.size + 0.5 * frame.counts.z;
    r.depth = frame.suns[sun].direction.w - dot(frame.suns[sun].direction.xyz, position);
    vec2 slope = vec2(dot(normal, frame.suns[sun].axis_x.xyz), dot(normal, frame.suns[sun].axis_y.xyz)) /
                 max(facing, kLeastFacing);
    r.gradient = slope * r.size;
    float steepness = length(slope);

    // Rounding of positions and of the rasteriser's sub-texel grid, felt more on steep planes.
    float slack = 2.0e-4 + 1.0e-5 * r.depth + r.size * (0.05 + 0.1 * steepness);
    float narrowing = frame.target.z / max(1.0 - frame.target.z * steepness, 0.5);

    float reach = narrowing * r.depth / r.size;  // texels; no blocker stands higher than depth 0
    float lit = -1.0;
    int levels = textureQueryLevels(sun_range);
    int step = 0;
    do {
        if (reach <= 0.75) break;
        // Blocks as wide as the reach: with its neighbours a block holds the whole kernel, and nothing beyond two blocks.
        int mip = clamp(((floatBitsToInt(reach) >> 23) - 126) - 2, 0, levels - 1);  // the exponent: ceil(log2)
        vec2 range = texelFetch(sun_range, ivec3(ivec2(r.texel) >> (mip + 2), r.layer), mip).rg * r.scale;
        if (r.depth - steepness * r.size * 2.0 * float(1 << (mip + 2)) - range.y > slack) {
            lit = 0.0;
            break;
        }
        float closer = narrowing * max(r.depth - range.x, 0.0) / r.size;
        if (closer > 0.7 * reach) {
            reach = min(reach, closer);
            break;
        }
        reach = closer;
    } while (++step < 3 && reach > 0.75);
    float open = lit_share(r, reach, slack, lit < 0.0 && reach > 0.75 ? SHADOW_TAPS : 0);
    if (lit < 0.0) lit = open;
#ifdef BLEND_CASTERS
    // A pane must not dim itself: it counts from a little behind its own plane, as steep as that is.
    float behind = r.depth - slack - 2.0 * r.size * steepness - 1.0e-3;
    ivec2 at = ivec2(r.texel * (vec2(textureSize(sun_veils, 0).xy) / frame.counts.z));
    int i = 0;
    do {
        vec2 veil = texelFetch(sun_veils, ivec3(at, r.layer * kVeils + i), 0).rg;
        if (veil.r * r.scale >= behind) break;
        lit *= veil.g;
    } while (++i < kVeils && lit > 0.0);
#endif
    return lit;
}
