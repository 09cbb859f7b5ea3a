// What the day lightmap's look-up and the relight pass must agree on.
#ifndef SHADERS_SHARED_LIGHTMAP_H
#define SHADERS_SHARED_LIGHTMAP_H
#include "shaders/shared/glsl.h"
SHARED_BEGIN

const int kLightmapTileSide = 16;  // texels that share their patterns, along either side of the atlas
const int kLightmapPatterns = 24;  // of a tile, at most; one number a texel, so as many numbers as eight RGB images

SHARED_END
#endif
