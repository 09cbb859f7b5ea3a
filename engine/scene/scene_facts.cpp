#include "engine/scene/scene_facts.h"

#include <algorithm>

#include "engine/scene/texture.h"

namespace daylit {
namespace {

constexpr float kMirrorReflectance = 0.25f;

struct Gloss {
    float exponent = 0.0f;
    bool mirror = false;
};

/// Of a material's factors, or of the smoothest texel where a texture sets roughness or metalness.
Gloss material_gloss(const Scene& scene, const Material& material) {
    if (material.unlit) return {};
    Material factors = material;
    const int texture = material.metallic_roughness_texture.texture;
    if (texture >= 0) {
        const Image8& image = scene.images[std::size_t(scene.textures[std::size_t(texture)].image)];
        std::uint8_t smoothest = 255, most_metallic = 0;
        for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
            smoothest = std::min(smoothest, image.rgba[i + 1]);
            most_metallic = std::max(most_metallic, image.rgba[i + 2]);
        }
        factors.roughness *= float(smoothest) / 255.0f;
        factors.metallic *= float(most_metallic) / 255.0f;
        factors.metallic_roughness_texture = TextureRef();
    }
    factors.base_color_texture = TextureRef();
    const glsl::Brdf brdf = surface_brdf(scene, factors, {}, Rgba(1.0f));
    const float reflectance = std::max({brdf.specular.x, brdf.specular.y, brdf.specular.z});
    Gloss gloss;
    if (reflectance >= kVisibleGloss) gloss.exponent = brdf.exponent;
    gloss.mirror = reflectance >= kMirrorReflectance && brdf.exponent >= glsl::kMaxPhongExponent;
    return gloss;
}

void count_primitive(const Scene& scene, const std::vector<Gloss>& gloss, const Node& node, const Primitive& primitive,
                     SceneFacts& facts) {
    const std::size_t copies = std::max<std::size_t>(node.instances.size(), 1);
    if (primitive.topology == Topology::Points) {
        facts.points += copies * primitive.indices.size();
        return;
    }
    const std::size_t triangles = copies * (primitive.indices.size() / 3);
    const auto m = std::size_t(primitive.material);
    const Material& material = scene.materials[m];
    (node.dynamic ? facts.dynamic_triangles : facts.static_triangles) += triangles;
    if (material.emission != Rgb(0.0f)) facts.emissive_triangles += triangles;
    if (material.emission != Rgb(0.0f) && material.lit == Lit::Evening) facts.evening_triangles += triangles;
    if (material.alpha_mode == AlphaMode::Mask) facts.masked_triangles += triangles;
    const bool sheer =
        material.base_color.a < 1.0f || material.base_color_texture.texture >= 0 || !primitive.colors.empty();
    if (material.alpha_mode == AlphaMode::Blend && sheer) facts.blended_triangles += triangles;
    facts.has_glass |= material.transmission > 0.0f;
    facts.has_mirror |= gloss[m].mirror;
    if (!node.dynamic && gloss[m].exponent > facts.static_exponent) {
        facts.static_exponent = gloss[m].exponent;
        facts.glossiest_material = material.name;
    }
}

}  // namespace

SceneFacts scene_facts(const Scene& scene) {
    SceneFacts facts;
    std::vector<Gloss> gloss;
    for (const Material& material : scene.materials) gloss.push_back(material_gloss(scene, material));
    for (const int n : scene.order) {
        const Node& node = scene.nodes[std::size_t(n)];
        if (node.mesh == -1) continue;
        ++(node.dynamic ? facts.dynamic_nodes_with_mesh : facts.static_nodes_with_mesh);
        for (const Primitive& primitive : scene.meshes[std::size_t(node.mesh)].primitives)
            count_primitive(scene, gloss, node, primitive, facts);
    }
    for (const PunctualLight& light : scene.lights) {
        ++(light.kind == LightKind::Directional ? facts.directional_lights
           : light.kind == LightKind::Spot      ? facts.spot_lights
                                                : facts.point_lights);
        facts.evening_lights += light.kind != LightKind::Directional && light.lit == Lit::Evening;
    }
    facts.bounds = bounds(world_mesh(scene, pose_scene(scene), Part::All));
    return facts;
}

}  // namespace daylit
