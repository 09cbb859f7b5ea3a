// The display curve: exposed linear Rec. 709 in, display-linear Rec. 709 in [0,1] out; sRGB coding comes after it.
#ifndef SHADERS_SHARED_TONEMAP_H
#define SHADERS_SHARED_TONEMAP_H
#include "shaders/shared/glsl.h"
SHARED_BEGIN

// Filmic curve with a toe and a shoulder, per channel: the rational fit of the ACES RRT + ODT by Narkowicz 2015,
// x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14); its input is scaled by 0.6 so that middle grey keeps its level.
SHARED_FN vec3 filmic(vec3 x) {
    x = max(x * 0.6f, vec3(0.0f));
    return clamp((x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f), vec3(0.0f), vec3(1.0f));
}

SHARED_END
#endif
