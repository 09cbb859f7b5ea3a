// Punctual lamps: irradiance on a facing plane, and hard shadows from perspective maps (a point has no penumbra).
layout(std140, binding = 2) uniform Lamps { LampsBlock lamp_block; };
layout(binding = 8) uniform sampler2DArray lamp_depth;  // near / distance along the map's axis; 0 where nothing is

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

// The frame of a cube's face: axis along the major direction, as lamp_shadow.cpp draws it.
void cube_face(vec3 d, out int face, out vec3 x, out vec3 y, out vec3 z) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) {
        face = d.x > 0.0 ? 0 : 1;
        z = vec3(sign(d.x), 0.0, 0.0);
        x = vec3(0.0, 1.0, 0.0);
    } else if (a.y >= a.z) {
        face = d.y > 0.0 ? 2 : 3;
        z = vec3(0.0, sign(d.y), 0.0);
        x = vec3(0.0, 0.0, 1.0);
    } else {
        face = d.z > 0.0 ? 4 : 5;
        z = vec3(0.0, 0.0, sign(d.z));
        x = vec3(1.0, 0.0, 0.0);
    }
    y = cross(z, x);
}

float lamp_visibility(int i, vec3 to_lamp, vec3 normal) {
    if (dot(normal, to_lamp) <= 0.0) return 0.0;
    vec3 d = -to_lamp;
    int face = 0;
    vec3 x, y, z;
    cube_face(d, face, x, y, z);
    float side = frame.counts.w, span = 1.0 + kLampBorder / side;
#ifdef SPOTS
    if (lamp_block.lamps[i].map.x > 0.0) {
        span = lamp_block.lamps[i].map.x;
        face = 0;
        x = lamp_block.lamps[i].axis_x.xyz;
        z = lamp_block.lamps[i].direction.xyz;
        y = cross(z, x);
    }
#endif
    vec3 p = vec3(dot(x, d), dot(y, d), dot(z, d));
    vec3 n = vec3(dot(x, normal), dot(y, normal), dot(z, normal));
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
