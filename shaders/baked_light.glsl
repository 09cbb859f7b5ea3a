// Baked indirect light for any program: include this, bind BakedLight::texture() to unit 4, pass the lightmap's uv.
layout(binding = 4) uniform sampler2D baked_irradiance_map;  // lux, this hour's

// Indirect irradiance in lux; radiance of a Lambert surface is albedo * this / pi.
vec3 baked_irradiance(vec2 lightmap_uv) {
    return texture(baked_irradiance_map, lightmap_uv).rgb;
}
