#include "engine/scene/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daylit {
namespace {

const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = decode_srgb(float(i) / 255.0f);
        return values;
    }();
    return table;
}

/// i lies within a few periods of the image, as near_origin() sees to: steps are cheaper than a division.
int wrapped(int i, int size, Wrap wrap) {
    if (wrap == Wrap::Clamp) return std::clamp(i, 0, size - 1);
    const int period = wrap == Wrap::Mirror ? 2 * size : size;
    while (i < 0) i += period;
    while (i >= period) i -= period;
    return i < size ? i : period - 1 - i;
}

/// Coordinates far outside 0..1 are brought near it first, so that floor() of a float texel position stays exact and
/// fits an int; 2 is a whole period of every wrap mode.
float near_origin(float u, Wrap wrap) {
    return wrap == Wrap::Clamp ? std::clamp(u, -1.0f, 2.0f) : u - 2.0f * std::floor(0.5f * u);
}

// How the four bytes of a texel are read.
Rgba as_coded(const std::uint8_t* p) {
    return Rgba(p[0], p[1], p[2], p[3]) / 255.0f;
}
Rgba decoded(const std::uint8_t* p) {
    const std::array<float, 256>& decode = srgb_table();
    return Rgba(decode[p[0]], decode[p[1]], decode[p[2]], float(p[3]) / 255.0f);
}
float alpha_alone(const std::uint8_t* p) {
    return float(p[3]) / 255.0f;
}

Vec2 transformed_uv(const TextureRef& ref, const std::array<Vec2, 2>& uvs) {
    const Vec2 uv = uvs[std::size_t(ref.uv_set)];
    if (!ref.has_transform()) return uv;
    const std::array<float, 6>& m = ref.transform;
    return Vec2(m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]);
}

template <auto Read>
auto sample(const Scene& scene, const TextureRef& ref, const std::array<Vec2, 2>& uvs) -> decltype(Read(nullptr)) {
    if (ref.texture < 0) return decltype(Read(nullptr))(1.0f);
    const Texture& texture = scene.textures[std::size_t(ref.texture)];
    const Image8& image = scene.images[std::size_t(texture.image)];
    const auto texel = [&](int x, int y) {
        const auto column = std::size_t(wrapped(x, image.width, texture.wrap_s));
        const auto row = std::size_t(wrapped(y, image.height, texture.wrap_t));
        return Read(&image.rgba[4 * (row * std::size_t(image.width) + column)]);
    };
    const Vec2 uv = transformed_uv(ref, uvs);
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return texel(0, 0);
    const float x = near_origin(uv.x, texture.wrap_s) * float(image.width);
    const float y = near_origin(uv.y, texture.wrap_t) * float(image.height);
    if (texture.filter == Filter::Nearest) return texel(int(std::floor(x)), int(std::floor(y)));
    // OpenGL 4.5, section 8.14.3: texel centres lie at halves.
    const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
    const float fx = x - 0.5f - left, fy = y - 0.5f - top;
    const int ix = int(left), iy = int(top);
    return glm::mix(glm::mix(texel(ix, iy), texel(ix + 1, iy), fx),
                    glm::mix(texel(ix, iy + 1), texel(ix + 1, iy + 1), fx), fy);
}

float after_alpha_mode(const Material& material, float alpha) {
    if (material.alpha_mode == AlphaMode::Opaque) return 1.0f;
    if (material.alpha_mode == AlphaMode::Mask) return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    return alpha;
}

/// Normal reflectance of a dielectric coat (KHR_materials_ior, KHR_materials_specular), at most 1.
Rgb dielectric_f0(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs) {
    const float ratio = (material.ior - 1.0f) / (material.ior + 1.0f);
    const Rgb color = material.specular_color * Rgb(sample_texture_srgb(scene, material.specular_color_texture, uvs));
    const float strength = material.specular * sample<alpha_alone>(scene, material.specular_texture, uvs);
    return glm::min(ratio * ratio * color, Rgb(1.0f)) * strength;
}

}  // namespace

Rgba sample_texture(const Scene& scene, const TextureRef& ref, const std::array<Vec2, 2>& uvs) {
    return sample<as_coded>(scene, ref, uvs);
}

Rgba sample_texture_srgb(const Scene& scene, const TextureRef& ref, const std::array<Vec2, 2>& uvs) {
    return sample<decoded>(scene, ref, uvs);
}

Rgba base_color(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs,
                const Rgba& vertex_color) {
    Rgba color = material.base_color * vertex_color * sample_texture_srgb(scene, material.base_color_texture, uvs);
    color.a = after_alpha_mode(material, color.a);
    return color;
}

float coverage(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs, float vertex_alpha) {
    return after_alpha_mode(
        material, material.base_color.a * vertex_alpha * sample<alpha_alone>(scene, material.base_color_texture, uvs));
}

Rgb emission(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs) {
    if (material.emission == Rgb(0.0f)) return Rgb(0.0f);
    return material.emission * Rgb(sample_texture_srgb(scene, material.emission_texture, uvs));
}

float transmission(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs) {
    return material.transmission * sample_texture(scene, material.transmission_texture, uvs).r;
}

glsl::Brdf surface_brdf(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs,
                        const Rgba& vertex_color) {
    if (material.unlit) return {Rgb(0.0f), Rgb(0.0f), 0.0f};
    const Rgba mr = sample_texture(scene, material.metallic_roughness_texture, uvs);
    const Rgb color = Rgb(base_color(scene, material, uvs, vertex_color));
    return glsl::brdf_from_metallic_roughness(color, material.metallic * mr.b, material.roughness * mr.g,
                                              dielectric_f0(scene, material, uvs));
}

Vec3 shading_normal(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs, const Vec3& normal,
                    const Vec4& tangent) {
    if (material.normal_texture.texture < 0 || Vec3(tangent) == Vec3(0.0f)) return normal;
    Vec3 local = Vec3(sample_texture(scene, material.normal_texture, uvs)) * 2.0f - 1.0f;
    local.x *= material.normal_scale;
    local.y *= material.normal_scale;
    const Vec3 bitangent = glm::cross(normal, Vec3(tangent)) * tangent.w;
    const Vec3 mapped = local.x * Vec3(tangent) + local.y * bitangent + local.z * normal;
    const float length = glm::length(mapped);
    return length > 1e-6f ? mapped / length : normal;
}

float mean_cosine(const Scene& scene, const Material& material) {
    if (material.normal_texture.texture < 0) return 1.0f;
    const Texture& texture = scene.textures[std::size_t(material.normal_texture.texture)];
    const std::vector<std::uint8_t>& rgba = scene.images[std::size_t(texture.image)].rgba;
    double sum = 0.0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const Vec3 local = Vec3(rgba[i], rgba[i + 1], rgba[i + 2]) / 127.5f - 1.0f;
        const float length = glm::length(local * Vec3(Vec2(material.normal_scale), 1.0f));
        // One that leans under the surface is mirrored above it when it is met.
        sum += length > 1e-6f ? double(std::abs(local.z) / length) : 1.0;
    }
    return rgba.empty() ? 1.0f : float(sum / (double(rgba.size()) / 4.0));
}

}  // namespace daylit
