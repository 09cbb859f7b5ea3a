#pragma once
// Which parts of a bake a scene needs, and why: one decision for `bake`, `check` and `info` (design.md, section 5).
#include <span>
#include <string>
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

}  // namespace daylit
