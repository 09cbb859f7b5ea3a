#pragma once
// The lightmap read at free points rather than at a drawn surface.
#include <vector>

#include "engine/baked/day_lightmap.h"
#include "engine/scene/scene.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

/// Where each point lies in the atlas: at the place of the static surface nearest to it, among surfaces that face its
/// normal where there are any.
/// corner_uvs   three per triangle of the scene's static mesh
std::vector<Vec2> lightmap_uvs(const std::vector<Vec2>& corner_uvs, const Scene& scene,
                               const std::vector<SurfaceSample>& points);

/// Indirect irradiance, lux, of the lightmap there.
/// lightmap   made for this scene's static mesh (checked when it was loaded)
std::vector<Rgb> lightmap_irradiance(const DayLightmap& lightmap, const Scene& scene,
                                     const LightScales& scales, double hour,
                                     const std::vector<SurfaceSample>& points);

}  // namespace daylit
