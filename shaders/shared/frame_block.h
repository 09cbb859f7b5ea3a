// Uniform blocks that C++ fills and GLSL reads. Only vec4 and mat4 inside, so that std140 and C++ agree.
#ifndef SHADERS_SHARED_FRAME_BLOCK_H
#define SHADERS_SHARED_FRAME_BLOCK_H
#include "shaders/shared/glsl.h"
SHARED_BEGIN

const int kMaxSuns = 4;
const int kMaxCascades = 4;                       // of one sun
const int kMaxSunLayers = kMaxSuns * kMaxCascades;
const int kMaxLamps = 128;

// One sun. Its shadow space: x and y in metres across the light, z in metres along it, 0 at the highest caster.
struct SunBlock {
    vec4 axis_x;      // xyz unit; w: layer of its first cascade
    vec4 axis_y;      // xyz unit; w unused
    vec4 direction;   // towards it; w: dot(direction, highest caster), so that depth = w - dot(direction, p)
    vec4 irradiance;  // lux facing it; w: metres of depth that the stored range [0,1] stands for
    vec4 radiance;    // of the disc, cd/m^2; w: number of cascades
};

struct FrameBlock {
    mat4 clip_from_world;
    mat4 world_from_clip;  // for directions of sky pixels
    vec4 eye;              // w: 1 for an orthographic view
    vec4 forward;          // unit, where the view looks; w: radians that a pixel spans at the centre
    vec4 target;           // width, height in samples; z: tan of the sun's radius; w: cos of it
    vec4 counts;           // suns, lamps, texels along a cascade's side, texels along a lamp map's side
    SunBlock suns[kMaxSuns];
    vec4 cascades[kMaxSunLayers];  // sun * kMaxCascades + cascade: centre x, y in shadow space, texel, usable half side
};

const float kLampNear = 0.01f;    // metres; nothing nearer to a lamp casts a shadow
const float kLampBorder = 4.0f;  // texels that a map spans beyond its angle, so that a filter at the rim stays inside

// One punctual lamp. A point lamp is told by the first two alone.
struct LampBlock {
    vec4 position;   // w: 1 / range^4, 0 for infinite
    vec4 intensity;  // cd; w: first layer of its maps
    vec4 direction;  // the way it shines, unit; w: 1 / (cos inner - cos outer)
    vec4 axis_x;     // of a spot's map, unit; y is cross(direction, x); w: cos of the outer cone, -2 for a point lamp
    vec4 map;        // x: tan of half the angle that its one map spans, 0 for a cube of six
};

struct LampsBlock {
    LampBlock lamps[kMaxLamps];
};

// A material's factors. Textures are bound by the draw; a texture that is absent has no code in the program.
struct MaterialBlock {
    vec4 base_color;
    vec4 emission;        // cd/m^2; w: alpha cutoff
    vec4 metal_rough;     // metallic, roughness, normal scale, transmission
    vec4 dielectric;      // f0 of the coat per channel, to be cut at 1; w: factor of what is left
    vec4 transforms[14];  // rows of the 2x3 texture transforms, as Material::textures(); w of the upper: the UV set
};

SHARED_END
#ifdef __cplusplus
namespace daylit::glsl {
static_assert(sizeof(SunBlock) == 5 * 16);
static_assert(sizeof(FrameBlock) == 2 * 64 + 4 * 16 + 4 * sizeof(SunBlock) + 16 * 16);
static_assert(sizeof(LampBlock) == 5 * 16);
static_assert(sizeof(MaterialBlock) == 18 * 16);
}  // namespace daylit::glsl
#endif
#endif
