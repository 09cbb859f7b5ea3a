#pragma once
// What a picture shows; `shot` and `reference` mean the same by the same name.
#include <string>

namespace daylit {

/// Direct: emission and sky seen by the camera (through coverage and smooth glass as well) plus light arriving straight
/// from suns and punctual lamps. Indirect: all the rest (skylight, light of emissive surfaces, every bounce).
/// Final: their sum. These three are radiance in cd/m^2. Irradiance: E in lux at the first surface, all light.
/// Albedo: diffuse + specular albedo. Normal: shading normal * 0.5 + 0.5. Depth: metres along the ray, 0 for the sky.
/// The others: E of one baked part alone, lux.
enum class Layer {
    Final, Direct, Indirect, Irradiance, Albedo, Normal, Depth, Lightmap, Volume, Dirmap, Antiradiance, Caustics
};

/// throws UsageError that lists the names.
Layer parse_layer(const std::string& name);
const char* name(Layer layer);

}  // namespace daylit
