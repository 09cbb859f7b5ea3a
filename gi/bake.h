#pragma once
// Scene + settings -> Baked. The stages, in order, are bake.cpp; what runs and why is bake_plan.h.
#include "engine/baked/baked_file.h"
#include "engine/scene/scene.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

struct BakeSettings {
    LightSettings light;
    double unit = 1.0;
    bool lambert = false;
    double error = 0.10;  // target relative error of a texel's irradiance: sets rays per texel, texel size, components
    double from_hour = 0.0, to_hour = 24.0;
    double every_hours = 0.5;
    int bounces = 8;
    std::uint64_t seed = 1;
    std::vector<std::string> parts;  // empty: auto
};

Baked bake(const Scene& scene, const BakeSettings& settings, const Progress& progress = {});

}  // namespace daylit
