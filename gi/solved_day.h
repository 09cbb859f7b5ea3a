#pragma once
// The day's light, solved and not yet encoded: where every encoder starts, so that several encodings of one solution
// can be compared.
#include "engine/baked/day_lightmap.h"
#include "gi/bake_plan.h"
#include "gi/encode/light_rows.h"
#include "gi/surface/kept_layout.h"
#include "gi/surface/reachable.h"
#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/probe_light.h"
#include "gi/transport/day_gather/texel_tilts.h"

namespace daylit {

/// What is to be baked, and how.
struct BakeInput {
    /// The scene must outlive this. throws Error when settings ask for parts that this version does not bake.
    BakeInput(const Scene& from, const BakeSettings& how);

    const Scene& scene;
    BakeSettings settings;
    WorldMesh mesh;  // static
    std::vector<PlacedLight> lamps;
    LightModel light;
    BakePlan plan;

    bool lit() const { return plan.lightmap || plan.volume; }
};

/// One solution for all parts: light at texels, and what leaves them for probes, at all hours.
struct SolvedDay {
    /// The input, which has some part to bake, must outlive this. throws Interrupted when progress says so.
    SolvedDay(const BakeInput& from, const Progress& progress);
    SolvedDay(const SolvedDay&) = delete;   // its members refer to each other
    static constexpr double kShare = 0.85;  // of a bake's progress

    const BakeInput& input;
    GatherSettings how;
    RayScene rays;
    Reachable reachable;
    KeptLayouts kept;
    Atlas atlas;
    Texels texels;
    GatherScene gather;
    GatherHits hits;
    DaySolution day;
    std::vector<Moment> moments;  // at which encodings of it are judged

    LeavingLight leaving() const;
    /// Frees what probes do not look at: what the rays of texels met, and the light of texels.
    void keep_for_probes();
};

}  // namespace daylit
