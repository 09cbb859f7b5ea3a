#include "gi/transport/day_gather/sight.h"

#include <cmath>

#include "gi/surface/parting.h"
#include "gi/transport/path_trace/bsdf.h"
#include "gi/transport/path_trace/panes.h"

namespace daylit {
namespace {

constexpr int kGlassEvents = 8;

}  // namespace

std::uint32_t texel_at(const GatherScene& scene, const Ray& ray, const Hit& hit) {
    if (scene.texels.walled.empty()) return scene.texels.at(scene.atlas, hit.triangle, hit.barycentric);
    return texel_in_sight(scene.rays, scene.atlas, scene.texels, hit.triangle, hit.barycentric,
                          ray.origin + hit.distance * ray.direction, glm::dot(ray.direction, hit.normal) > 0.0f);
}

Sight::Sight(const GatherScene& scene)
    : scene_(scene),
      materials_(scene.rays.scene()),
      emitters_(scene.rays, materials_),
      panes_(find_panes(scene.rays.mesh(), materials_)) {}

std::optional<Hit> Sight::past_glass(Ray& ray, Random& random) const {
    const WorldMesh& mesh = scene_.rays.mesh();
    std::optional<Hit> met = scene_.rays.closest(ray, random.bits());
    for (int events = 0; met && events < kGlassEvents && materials_.glass(mesh.materials[met->triangle]); ++events) {
        const SurfacePoint point = scene_.rays.surface_point(ray, *met);
        if (!materials_.meets_glass(point, random)) return met;
        const float ior = scene_.rays.scene().materials[point.material].ior;
        const bool pane = panes_[met->triangle], entering = glm::dot(ray.direction, met->normal) < 0.0f;
        const float u = random.next();
        const GlassBounce bounce =
            pane ? sample_pane(ray.direction, point.geometric_normal, ior, u)
                 : sample_glass(ray.direction, point.geometric_normal, entering ? ior : 1.0f / ior, u);
        const float tint = luminance(materials_.color(point));
        if (bounce.transmitted && random.next() >= (pane ? tint : std::sqrt(tint))) return met;
        ray = {RayScene::offset_origin(point.position, point.geometric_normal, bounce.direction), bounce.direction};
        met = scene_.rays.closest(ray, random.bits());
    }
    return met;
}

Rgb Sight::emission(const Ray& ray, const Hit& hit) const {
    return materials_.emission(scene_.rays.surface_point(ray, hit));
}

float Sight::emitter_pdf(const Ray& ray, const Hit& hit) const {
    return emitters_.pdf(hit.triangle, hit.distance, glm::dot(ray.direction, hit.normal));
}

float Sight::open(const Vec3& origin, const Vec3& from, const LightSample& light) const {
    const Vec3 end = RayScene::offset_origin(from + light.distance * light.direction, light.normal, -light.direction);
    const float length = glm::dot(end - origin, light.direction);
    return length > 0.0f ? scene_.rays.transmittance({origin, light.direction, 0.0f, length}) : 0.0f;
}

}  // namespace daylit
