#pragma once
// What a scene holds, in numbers: the ground for deciding what to bake, draw and skip.
#include "engine/scene/pose.h"
#include "engine/scene/scene.h"

namespace daylit {

struct SceneFacts {
    std::size_t static_triangles = 0, dynamic_triangles = 0;  // as placed, instances counted
    std::size_t points = 0;                                   // of glTF POINTS, as placed
    std::size_t static_nodes_with_mesh = 0, dynamic_nodes_with_mesh = 0;
    std::size_t directional_lights = 0, point_lights = 0, spot_lights = 0;
    std::size_t emissive_triangles = 0;
    std::size_t evening_lights = 0, evening_triangles = 0;    // of these: lit in the evening only
    std::size_t masked_triangles = 0, blended_triangles = 0;  // blended: some coverage below 1
    float static_exponent =
        0.0f;  // largest Phong exponent of a static surface whose lobe reflects kVisibleGloss or more
    std::string glossiest_material;  // the one that has it
    bool has_glass = false;          // transmission
    bool has_mirror = false;         // a lobe of kMaxPhongExponent that reflects a quarter or more
    Bounds bounds;                   // of all triangles at rest; empty when there are none

    bool has_static() const { return static_triangles > 0; }
    bool has_dynamic() const { return dynamic_nodes_with_mesh > 0; }
};

/// Share of light below which a lobe's reflection is not worth a map of its own.
inline constexpr float kVisibleGloss = 0.03f;

SceneFacts scene_facts(const Scene& scene);

}  // namespace daylit
