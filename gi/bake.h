#pragma once
// Scene + settings -> Baked. The stages, in order, are bake.cpp; what runs, how finely and why is bake_plan.h.
#include "engine/baked/baked_file.h"
#include "engine/base/progress.h"
#include "engine/scene/scene.h"
#include "gi/encode/volume_settings.h"

namespace daylit {

/// Departures from what bake_plan chooses by BakeSettings::error, for reports that vary one thing at a time.
struct BakeTuning {
    // Times the plan's own number of rays per receiver, of texels, of a volume's cells.
    double rays = 1.0, texels = 1.0, cells = 1.0;
};

struct BakeSettings {
    LightSettings light;
    double unit = 1.0;  // only noted in the file: the scene is in metres already
    bool lambert = false;
    double error = 0.10;  // target relative error of a texel's irradiance: sets rays per texel, texel size, components
    double from_hour = 0.0, to_hour = 24.0;
    double every_hours = 1.0 / 12.0;
    int bounces = 64;  // at most; ends when the rest no longer counts
    std::uint64_t seed = 1;
    bool directional = true;  // lightmaps hold how light changes as the normal leans, where surfaces have normal maps
    bool keep_uv2 = false;    // the scene's own TEXCOORD_1 as the lightmap's layout
    VolumeSettings volume;    // what is zero in it follows from `error`
    std::vector<std::string> parts;  // empty: auto
    /// Where the state of an unfinished bake is kept, for `resume` to go on from; empty: nowhere. Whoever asks for the
    /// bake removes the file once its result is safe.
    std::filesystem::path checkpoint;
    bool resume = false;
    BakeTuning tuning;
};

/// Indirect light of the static geometry (dynamic nodes take no part). Same inputs, same bytes, for any number of
/// threads, and when it was interrupted and resumed. throws Interrupted when progress says so, Error for what cannot be
/// baked.
Baked bake(const Scene& scene, const BakeSettings& settings, const Progress& progress = {});

}  // namespace daylit
