#pragma once
// Which parts of a bake a scene needs, and why: one decision for `bake`, `check` and `info` (design.md, section 5).
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/baked/baked_file.h"
#include "engine/scene/scene_facts.h"

namespace daylit {

/// A DIRmap has 64 cells on the hemisphere, of 0.098 sr each: cones of 0.177 rad. A Phong lobe's radius is sqrt(2 / n),
/// so from this exponent on it is narrower than a cell, and blurred irradiance no longer stands in for it.
inline constexpr float kDirmapExponent = 64.0f;

/// One item a part (lightmap, volume, dirmap, antiradiance, caustics), with done = "the scene needs it".
/// asked   names of parts wanted whatever the scene says; empty: by the scene alone ("auto")
std::vector<PlanItem> plan_parts(const SceneFacts& facts, std::span<const std::string> asked = {});

/// Whether this version bakes a part, or only knows whether a scene has use for it.
bool bakes_part(std::string_view part);
/// The plan as this version carries it out: what it does not bake is not done, and said to be missed.
std::vector<PlanItem> plan_of_this_version(std::vector<PlanItem> plan);

}  // namespace daylit
