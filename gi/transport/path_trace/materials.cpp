#include "gi/transport/path_trace/materials.h"

namespace daylit {

Materials::Materials(const Scene& scene, float evening) : scene_(scene) {
    constants_.reserve(scene.materials.size());
    for (const Material& m : scene.materials) {
        Constants c;
        c.unlit = m.unlit;
        c.glass = !m.unlit && m.transmission > 0.0f;
        c.shining = m.lit == Lit::Evening ? evening : 1.0f;
        c.emits = m.unlit || m.emission * c.shining != Rgb(0.0f);
        c.plain_brdf = m.base_color_texture.texture < 0 && m.metallic_roughness_texture.texture < 0 &&
                       m.specular_texture.texture < 0 && m.specular_color_texture.texture < 0;
        if (c.plain_brdf) c.brdf = surface_brdf(scene, m, {}, Rgba(1.0f));
        constants_.push_back(c);
    }
}

glsl::Brdf Materials::brdf(const SurfacePoint& point) const {
    const Constants& c = constants_[point.material];
    if (c.plain_brdf && Rgb(point.color) == Rgb(1.0f)) return c.brdf;
    return surface_brdf(scene_, scene_.materials[point.material], point.uvs, point.color);
}

Rgb Materials::color(const SurfacePoint& point) const {
    return Rgb(base_color(scene_, scene_.materials[point.material], point.uvs, point.color));
}

Rgb Materials::emission(const SurfacePoint& point) const {
    if (unlit(point.material)) return color(point);
    return daylit::emission(scene_, scene_.materials[point.material], point.uvs) * constants_[point.material].shining;
}

Rgb Materials::covered_emission(const WorldMesh& mesh, std::uint32_t triangle, const Vec2& barycentric) const {
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(triangle)];
    const Vec3 w(1.0f - barycentric.x - barycentric.y, barycentric.x, barycentric.y);
    std::array<Vec2, 2> uvs{};
    Rgba vertex_color(0.0f);
    for (int k = 0; k < 3; ++k) {
        for (std::size_t set = 0; set < 2; ++set) uvs[set] += w[k] * mesh.uvs[corner[k]][set];
        vertex_color += w[k] * mesh.colors[corner[k]];
    }
    const Material& material = scene_.materials[mesh.materials[triangle]];
    const Rgb radiance = daylit::emission(scene_, material, uvs) * constants_[mesh.materials[triangle]].shining;
    if (material.alpha_mode == AlphaMode::Opaque) return radiance;
    return radiance * base_color(scene_, material, uvs, vertex_color).a;
}

}  // namespace daylit
