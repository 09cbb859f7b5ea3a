// Baked indirect light in free space for any program: include this and call BakedVolume::bind().
#include "shaders/shared/frame_block.h"
#include "shaders/shared/sh.h"

layout(std140, binding = 3) uniform VolumeUniforms { VolumeBlock volume; };
layout(binding = 10) uniform sampler3D baked_volume_map;  // this hour's radiance SH, nine stacked along y

// Indirect irradiance in lux at a place, on the two sides of a plane with this unit normal.
struct TwoSided {
    vec3 front;
    vec3 back;
};

TwoSided volume_irradiance(vec3 place, vec3 normal) {
    // Texel centres are the probes; held between the first and the last, a fetch stays inside its own coefficient.
    vec3 texel = clamp((place - volume.origin.xyz) * volume.origin.w, vec3(0.0), volume.size.xyz - 1.0) + 0.5;
    vec3 step_between = vec3(0.0, volume.size.y, 0.0);
    vec3 whole = volume.size.xyz * vec3(1.0, float(kShCoefficients), 1.0);
    Sh9 weights = sh_irradiance_weights(normal);
    vec3 even = vec3(0.0), odd = vec3(0.0);  // bands 0 and 2, which a turned normal leaves as they are, and band 1
    for (int i = 0; i < kShCoefficients; ++i) {
        vec3 coefficient = weights.c[i] * textureLod(baked_volume_map, (texel + float(i) * step_between) / whole, 0.0).rgb;
        if (i >= 1 && i < 4) odd += coefficient;
        else even += coefficient;
    }
    return TwoSided(max(even + odd, vec3(0.0)), max(even - odd, vec3(0.0)));
}
