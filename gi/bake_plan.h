#pragma once
// What this scene needs, how finely, and why.
#include <vector>

#include "engine/scene/scene_facts.h"
#include "gi/bake.h"

namespace daylit {

struct BakePlan {
    std::vector<PlanItem> parts;  // what is baked, what is left out, and why; goes into the file
    bool lightmap = false, volume = false;
    std::size_t texel_budget = 0;  // of the lightmap
    int rays = 0;                  // per texel
    double more_rays = 0;          // mean per texel of those added where the noise is large
    VolumeSettings volume_settings;
    std::vector<double> hours;  // at which sun and sky are known
};

/// throws Error when settings ask for parts that this version does not bake.
BakePlan plan_bake(const SceneFacts& facts, const LightModel& light, const BakeSettings& settings);

/// Every `every` hours, from `from` to `to`, without those deep in the night, when the sun adds nothing; one hour alone
/// when the light is always the same.
std::vector<double> baked_hours(const LightModel& light, double from, double to, double every);

}  // namespace daylit
