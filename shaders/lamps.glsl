// Punctual lamps: irradiance on a facing plane, and hard shadows from perspective maps (a point has no penumbra).
layout(std140, binding = 2) uniform Lamps { LampsBlock lamp_block; };
layout(binding = 8) uniform sampler2DArray lamp_depth;  // near / distance along the map's axis; 0 where nothing is

// Sets of lamps have a bit for each; LAMPS words are used.
bool any_lamp(uvec4 bits) {
    uint any = 0u;
    for (int word = 0; word < LAMPS; ++word) any |= bits[word];
    return any != 0u;
}

// The number of the first lamp, which leaves the set.
int take_lamp(inout uvec4 bits) {
    int word = LAMPS - 1;
    for (int other = LAMPS - 2; other >= 0; --other)
        if (bits[other] != 0u) word = other;
    int lamp = 32 * word + findLSB(bits[word]);
    bits[word] &= bits[word] - 1u;
    return lamp;
}

// Lux on a plane that faces lamp i; to_lamp is the vector from the point to it. As facing_irradiance() in C++.
vec3 lamp_irradiance(int i, vec3 to_lamp) {
    float d2 = dot(to_lamp, to_lamp);
    if (d2 <= 0.0) return vec3(0.0);
    float window = clamp(1.0 - d2 * d2 * lamp_block.lamps[i].position.w, 0.0, 1.0);
    float cone = 1.0;
#ifdef SPOTS
    float cos_outer = lamp_block.lamps[i].axis_x.w;
    if (cos_outer > -1.5) {
        float cos_angle = -dot(lamp_block.lamps[i].direction.xyz, to_lamp) * inversesqrt(d2);
        cone = clamp((cos_angle - cos_outer) * lamp_block.lamps[i].direction.w, 0.0, 1.0);
        cone *= cone;
    }
#endif
    return lamp_block.lamps[i].intensity.rgb * (window * cone / d2);
}

// Turns point and normal, seen from the lamp, into the frame of the cube's face that the point lies in: x, y, and the axis
// along the major direction, as lamp_shadow.cpp draws it. Its axes are the world's in turn.
int to_cube_face(inout vec3 p, inout vec3 n) {
    vec3 a = abs(p);
    int face = 4;
    if (a.x >= a.y && a.x >= a.z) {
        face = 0;
        p = p.yzx;
        n = n.yzx;
    } else if (a.y >= a.z) {
        face = 2;
        p = p.zxy;
        n = n.zxy;
    }
    float way = p.z > 0.0 ? 1.0 : -1.0;
    p.yz *= way;
    n.yz *= way;
    return way > 0.0 ? face : face + 1;
}

float lamp_visibility(int i, vec3 to_lamp, vec3 normal) {
    if (dot(normal, to_lamp) <= 0.0) return 0.0;
    float side = frame.counts.w, span = 1.0 + kLampBorder / side;
    vec3 p = -to_lamp, n = normal;
    int face = to_cube_face(p, n);
#ifdef SPOTS
    if (lamp_block.lamps[i].map.x > 0.0) {
        span = lamp_block.lamps[i].map.x;
        face = 0;
        vec3 x = lamp_block.lamps[i].axis_x.xyz, z = lamp_block.lamps[i].direction.xyz;
        mat3 world_from_map = mat3(x, cross(z, x), z);
        p = -to_lamp * world_from_map;
        n = normal * world_from_map;
    }
#endif
    vec2 place = (p.xy / (p.z * span) * 0.5 + 0.5) * side;
    vec2 base = floor(place - 0.5);
    vec2 f = place - 0.5 - base;
    vec4 stored = textureGather(lamp_depth, vec3((base + 1.0) / side, lamp_block.lamps[i].intensity.w + float(face)));
    // Distance along the axis at which the ray through each texel's centre meets the receiver's plane.
    vec4 ray_x = ((base.x + vec4(0.5, 1.5, 1.5, 0.5)) / side * 2.0 - 1.0) * span;
    vec4 ray_y = ((base.y + vec4(1.5, 1.5, 0.5, 0.5)) / side * 2.0 - 1.0) * span;
    vec4 toward = n.x * ray_x + n.y * ray_y + n.z;  // negative where the plane faces the lamp
    vec4 plane = dot(n, p) / min(toward, vec4(-1.0e-4));
    vec4 slack = 1.0e-3 + plane * (0.4 * span / side);
    vec4 lit = step(stored * (plane - slack), vec4(kLampNear));
    vec2 rows = mix(lit.wx, lit.zy, f.x);
    return mix(rows.x, rows.y, f.y);
}
