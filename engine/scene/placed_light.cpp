// KHR_lights_punctual in the world.
#include <algorithm>
#include <cmath>

#include "engine/scene/pose.h"

namespace daylit {

std::vector<PlacedLight> placed_lights(const Scene& scene, const Pose& pose) {
    std::vector<PlacedLight> placed;
    for (const PunctualLight& light : scene.lights) {
        const Mat4& world = pose.world_from_node[std::size_t(light.node)];
        PlacedLight out;
        out.kind = light.kind;
        out.position = Vec3(world[3]);
        const glm::dvec3 forward = -glm::dvec3(world[2]);
        const double length = glm::length(forward);
        if (length > 0) out.direction = Vec3(forward / length);
        out.intensity = light.intensity;
        out.lit = light.lit;
        out.range = light.range;  // the extension leaves it unscaled by the node
        out.cos_inner = std::cos(light.inner_cone);
        out.cos_outer = std::cos(light.outer_cone);
        out.node = light.node;
        placed.push_back(out);
    }
    return placed;
}

Rgb facing_irradiance(const PlacedLight& light, const Vec3& to_light) {
    const float square = glm::dot(to_light, to_light);
    if (!(square > 0)) return Rgb(0.0f);
    float factor = 1.0f / square;
    if (light.range > 0) {
        const float ratio = square / (light.range * light.range);
        factor *= std::clamp(1.0f - ratio * ratio, 0.0f, 1.0f);
    }
    if (light.kind == LightKind::Spot) {
        const float cosine = glm::dot(light.direction, -to_light) / std::sqrt(square);
        // KHR_lights_punctual's recommended falloff: the square of a linear ramp in the cosine.
        const float ramp =
            std::clamp((cosine - light.cos_outer) / std::max(light.cos_inner - light.cos_outer, 1e-4f), 0.0f, 1.0f);
        factor *= ramp * ramp;
    }
    return light.intensity * factor;
}

}  // namespace daylit
