#pragma once
// Scenes of a few triangles for tests, made without files.
#include <memory>

#include "engine/scene/pose.h"
#include "engine/scene/sky.h"
#include "gi/trace/ray_scene.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

/// A Lambert surface of this albedo.
inline Material lambert(const Rgb& albedo, const Rgb& emission = Rgb(0.0f)) {
    Material m;
    m.base_color = Rgba(albedo, 1.0f);
    m.metallic = 0.0f;
    m.roughness = 1.0f;
    m.specular = 0.0f;
    m.emission = emission;
    m.double_sided = true;
    return m;
}

/// A metal whose Phong lobe is as narrow as they get.
inline Material mirror(const Rgb& albedo) {
    Material m = lambert(albedo);
    m.metallic = 1.0f;
    m.roughness = 0.0f;
    return m;
}

inline Material glass(float ior, const Rgb& tint = Rgb(1.0f)) {
    Material m = lambert(tint);
    m.transmission = 1.0f;
    m.ior = ior;
    return m;
}

/// Collects materials and triangles; the first trace() ends the collecting.
class TestScene {
  public:
    Scene scene;
    WorldMesh mesh;

    std::uint32_t add(const Material& material) {
        scene.materials.push_back(material);
        return std::uint32_t(scene.materials.size() - 1);
    }

    /// A texture of this image, as a reference to it by the first UV set.
    TextureRef add_texture(Image8 image, Filter filter = Filter::Nearest) {
        scene.images.push_back(std::move(image));
        scene.image_names.push_back("image");
        scene.textures.push_back({.image = int(scene.images.size() - 1), .filter = filter});
        return {.texture = int(scene.textures.size() - 1)};
    }

    void triangle(std::uint32_t material, const Vec3& a, const Vec3& b, const Vec3& c, const Vec2& ta = Vec2(0, 0),
                  const Vec2& tb = Vec2(1, 0), const Vec2& tc = Vec2(1, 1)) {
        const Vec3 cross = glm::cross(b - a, c - a);
        const Vec3 normal = glm::length(cross) > 0.0f ? glm::normalize(cross) : Vec3(0, 1, 0);
        for (const auto& [p, uv] : {std::pair(a, ta), std::pair(b, tb), std::pair(c, tc)}) {
            mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
            mesh.positions.push_back(p);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(glm::normalize(b - a), 1.0f);
            mesh.uvs.push_back({uv, uv});
            mesh.colors.emplace_back(1.0f);
        }
        mesh.materials.push_back(material);
        mesh.nodes.push_back(0);
    }

    /// The parallelogram origin, origin + u, origin + u + v, origin + v; its normal is cross(u, v).
    void quad(std::uint32_t material, const Vec3& origin, const Vec3& u, const Vec3& v) {
        triangle(material, origin, origin + u, origin + u + v, {0, 0}, {1, 0}, {1, 1});
        triangle(material, origin, origin + u + v, origin + v, {0, 0}, {1, 1}, {0, 1});
    }

    /// Six faces with normals out of the box.
    void box(std::uint32_t material, const Vec3& min, const Vec3& max) {
        const Vec3 d = max - min;
        const Vec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
        quad(material, min, y, x);
        quad(material, min + z, x, y);
        quad(material, min, z, y);
        quad(material, min + x, y, z);
        quad(material, min, x, z);
        quad(material, min + y, z, x);
    }

    const RayScene& trace() {
        if (!rays_) rays_ = std::make_unique<RayScene>(scene, mesh);
        return *rays_;
    }

  private:
    std::unique_ptr<RayScene> rays_;
};

inline Lighting constant_sky(const Rgb& radiance) {
    return {.suns = {}, .sky = {Image(1, 1, radiance)}};
}

inline Lighting no_light() {
    return constant_sky(Rgb(0.0f));
}

inline Lighting one_sun(const Vec3& direction, const Rgb& irradiance) {
    return {.suns = {{glm::normalize(direction), irradiance}}, .sky = {Image(1, 1)}};
}

/// A picture through a lens so long that all its rays start at `eye` along `direction`.
inline View pinpoint(const Vec3& eye, const Vec3& direction) {
    return look_at(eye, eye + direction, 1e-4f);
}

inline Rgb mean(const Image& image) {
    glm::dvec3 sum(0.0);
    for (const Rgb& p : image.pixels) sum += glm::dvec3(p);
    return Rgb(sum / double(image.pixels.size()));
}

/// Irradiance at one point by `samples` paths, all light.
inline Rgb irradiance_at(const RayScene& rays, const Lighting& lighting, const Vec3& position, const Vec3& normal,
                         int samples, std::uint64_t seed = 1) {
    // Split into many receivers, so that they go to all threads.
    constexpr int kParts = 64;
    const std::vector<SurfaceSample> points(kParts, SurfaceSample{position, normal});
    const std::vector<Rgb> parts = path_trace_irradiance(
        rays, lighting, {}, points, {.spp = samples / kParts, .seed = seed, .layer = Layer::Final});
    glm::dvec3 sum(0.0);
    for (const Rgb& e : parts) sum += glm::dvec3(e);
    return Rgb(sum / double(kParts));
}

}  // namespace daylit
