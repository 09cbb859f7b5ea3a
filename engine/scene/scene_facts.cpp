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

/// The least and the greatest of each channel of a texture, as coded; 1 without one.
std::array<Rgba, 2> texel_range(const Scene& scene, const TextureRef& ref) {
    if (ref.texture < 0) return {Rgba(1.0f), Rgba(1.0f)};
    const Image8& image = scene.images[std::size_t(scene.textures[std::size_t(ref.texture)].image)];
    std::array<std::uint8_t, 4> least{255, 255, 255, 255}, most{};
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        least[i % 4] = std::min(least[i % 4], image.rgba[i]);
        most[i % 4] = std::max(most[i % 4], image.rgba[i]);
    }
    return {Rgba(least[0], least[1], least[2], least[3]) / 255.0f, Rgba(most[0], most[1], most[2], most[3]) / 255.0f};
}

/// Of a material's factors, or of the glossiest texel where textures vary them.
Gloss material_gloss(const Scene& scene, const Material& material) {
    if (material.unlit) return {};
    Material factors = material;
    const auto [smoothest, most_metallic] = texel_range(scene, material.metallic_roughness_texture);
    factors.roughness *= smoothest.g;
    factors.metallic *= most_metallic.b;
    factors.specular *= texel_range(scene, material.specular_texture)[1].a;
    const Rgba brightest = texel_range(scene, material.specular_color_texture)[1];
    for (int c = 0; c < 3; ++c) factors.specular_color[c] *= decode_srgb(brightest[c]);
    factors.base_color_texture = factors.metallic_roughness_texture = factors.specular_texture =
        factors.specular_color_texture = TextureRef();
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
