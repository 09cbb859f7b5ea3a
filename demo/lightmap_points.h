#pragma once
// The lightmap read at free points rather than at a drawn surface.
#include <vector>

#include "engine/baked/day_lightmap.h"
#include "engine/scene/scene.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

/// Indirect irradiance, lux, of the lightmap at the place of the static surface nearest to each point, among surfaces
/// that face the point's normal where there are any.
/// lightmap   made for this scene's static mesh (checked when it was loaded)
std::vector<Rgb> lightmap_irradiance(const DayLightmap& lightmap, const Scene& scene,
                                     const LightScales& scales, double hour,
                                     const std::vector<SurfaceSample>& points);

}  // namespace daylit
