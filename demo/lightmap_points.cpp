#include "demo/lightmap_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>
#include <optional>

#include "gi/trace/ray_scene.h"

namespace daylit {
namespace {

struct MeshPlace {
    std::uint32_t triangle = 0;
    Vec2 barycentric = Vec2(0.0f);
};

/// The surface right under a point that lies on one: found by a short ray onto it along the normal.
std::optional<MeshPlace> place_under(const RayScene& rays, const SurfaceSample& point, float reach) {
    Ray ray{point.position + reach * point.normal, -point.normal, 0.0f, 2.0f * reach};
    constexpr int kSheets = 16;  // back to back, of which the one that faces the normal is wanted
    for (int sheet = 0; sheet < kSheets; ++sheet) {
        const std::optional<Hit> hit = rays.closest(ray, 0);
        if (!hit) return std::nullopt;
        if (glm::dot(hit->normal, point.normal) > 0.0f) return MeshPlace{hit->triangle, hit->barycentric};
        ray.t_min = std::nextafter(hit->distance, std::numeric_limits<float>::max());
    }
    return std::nullopt;
}

/// Barycentric weights of the second and third corner of the triangle's point nearest to p (Ericson 2005, 5.1.5).
Vec2 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0f && d2 <= 0.0f) return {0, 0};
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0f && d4 <= d3) return {1, 0};
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return {d1 / (d1 - d3), 0};
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0f && d5 <= d6) return {0, 1};
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return {0, d2 / (d2 - d6)};
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) {
        const float w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {1.0f - w, w};
    }
    return Vec2(vb, vc) / (va + vb + vc);
}

/// The nearest place of the whole mesh, by looking at every triangle; those that face away only when none faces.
MeshPlace nearest_place(const RayScene& rays, const SurfaceSample& point) {
    const WorldMesh& mesh = rays.mesh();
    MeshPlace best;
    float best_distance = std::numeric_limits<float>::max();
    bool best_faces = false;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        if (!rays.traced(t)) continue;
        const bool faces = glm::dot(rays.normal(t), point.normal) > 0.0f;
        if (best_faces && !faces) continue;
        const std::uint32_t* corner = &mesh.indices[3 * std::size_t(t)];
        const Vec3 &a = mesh.positions[corner[0]], &b = mesh.positions[corner[1]], &c = mesh.positions[corner[2]];
        const Vec2 w = nearest_on_triangle(point.position, a, b, c);
        const float distance = glm::distance(point.position, a + w.x * (b - a) + w.y * (c - a));
        if (distance < best_distance || (faces && !best_faces)) {
            best = {t, w};
            best_distance = distance;
            best_faces = faces;
        }
    }
    return best;
}

}  // namespace

std::vector<Vec2> lightmap_uvs(const std::vector<Vec2>& corner_uvs, const Scene& scene,
                               const std::vector<SurfaceSample>& points) {
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::Static);
    const RayScene rays(scene, mesh);
    constexpr float kReach = 1e-4f;  // of the scene's size
    const float reach = kReach * glm::distance(rays.bounds().min, rays.bounds().max);
    std::vector<Vec2> uvs(points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size()), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            const std::optional<MeshPlace> under = place_under(rays, points[i], reach);
            const MeshPlace place = under ? *under : nearest_place(rays, points[i]);
            const Vec2* uv = &corner_uvs[3 * std::size_t(place.triangle)];
            const Vec2 w = place.barycentric;
            uvs[i] = uv[0] + w.x * (uv[1] - uv[0]) + w.y * (uv[2] - uv[0]);
        }
    });
    return uvs;
}

std::vector<Rgb> lightmap_irradiance(const DayLightmap& lightmap, const Scene& scene,
                                     const LightScales& scales, double hour,
                                     const std::vector<SurfaceSample>& points) {
    const std::vector<Rgb> light = lightmap.tile_light(lightmap.basis.weights(scales, hour));
    std::vector<Rgb> irradiance;
    for (const Vec2& uv : lightmap_uvs(lightmap.corner_uvs, scene, points))
        irradiance.push_back(lightmap.irradiance(uv, light));
    return irradiance;
}

}  // namespace daylit
