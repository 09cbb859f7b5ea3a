#include "demo/sample_points.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/scene/texture.h"
#include "gi/surface/free_space.h"
#include "gi/transport/path_trace/sampling.h"

namespace daylit {
namespace {

constexpr int kTriesPerPoint = 1000;
constexpr int kLooks = 64;           // rays that decide whether a place can be seen
constexpr float kCovering = 1e-5f;   // of the scene's size: what lies this near covers a place

/// Areas summed up, in triangle order; triangles that cannot be sampled add nothing.
std::vector<double> summed_areas(const Scene& scene, const WorldMesh& mesh) {
    std::vector<double> sums(mesh.triangle_count());
    double sum = 0.0;
    for (std::size_t t = 0; t < sums.size(); ++t) {
        const std::uint32_t* corner = &mesh.indices[3 * t];
        const glm::dvec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        const Material& material = scene.materials[mesh.materials[t]];
        const bool glass = material.transmission > 0.0f && material.transmission_texture.texture < 0;
        if (std::isfinite(area) && !glass) sum += area;
        sums[t] = sum;
    }
    return sums;
}

Vec3 uniform_direction(Random& random) {
    const float y = 1.0f - 2.0f * random.next(), phi = 2.0f * float(kPi) * random.next();
    const float r = std::sqrt(std::max(1.0f - y * y, 0.0f));
    return Vec3(r * std::cos(phi), y, r * std::sin(phi));
}

/// Whether it sees the sky, or the front of something that does not lie upon it.
bool in_the_open(const RayScene& rays, const SurfaceSample& point, std::uint64_t seed) {
    const Bounds box = rays.bounds();
    const float covering = kCovering * glm::length(box.max - box.min);
    Random random(seed, 0, 1);
    for (int look = 0; look < kLooks; ++look) {
        const float u = random.next(), v = random.next();
        const Vec3 direction = Frame(point.normal).to_world(sample_cosine_hemisphere(u, v));
        const Vec3 origin = RayScene::offset_origin(point.position, point.normal, direction);
        const std::optional<Hit> hit = rays.closest({origin, direction}, std::uint64_t(look));
        if (!hit || (hit->distance > covering && glm::dot(direction, hit->normal) < 0.0f)) return true;
    }
    return false;
}

}  // namespace

std::vector<SurfaceSample> sample_surface(const RayScene& rays, const Pose& pose, int count, std::uint64_t seed) {
    const Scene& scene = rays.scene();
    WorldMesh mesh = world_mesh(scene, pose, Part::Static);
    if (mesh.triangle_count() == 0) mesh = world_mesh(scene, pose, Part::All);
    const std::vector<double> sums = summed_areas(scene, mesh);
    if (sums.empty() || !(sums.back() > 0.0)) throw Error(scene.path.string(), "has no opaque surface to sample");

    std::vector<SurfaceSample> points;
    Random random(seed, 0, 0);
    for (long tries = 0; points.size() < std::size_t(count); ++tries) {
        if (tries > long(count) * kTriesPerPoint)
            throw Error(scene.path.string(),
                        "its surfaces are cut away or covered nearly everywhere; found too few points");
        const auto place = std::upper_bound(sums.begin(), sums.end(), random.next_double() * sums.back());
        const auto t = std::size_t(std::min(place, sums.end() - 1) - sums.begin());
        const float root = std::sqrt(random.next()), v = random.next();
        const Vec3 weights(1.0f - root, root * (1.0f - v), root * v);
        const std::uint32_t* corner = &mesh.indices[3 * t];
        Vec3 position(0.0f);
        std::array<Vec2, 2> uvs{};
        Rgba color(0.0f);
        for (int k = 0; k < 3; ++k) {
            position += weights[k] * mesh.positions[corner[k]];
            color += weights[k] * mesh.colors[corner[k]];
            for (std::size_t set = 0; set < 2; ++set) uvs[set] += weights[k] * mesh.uvs[corner[k]][set];
        }
        const Material& material = scene.materials[mesh.materials[t]];
        if (transmission(scene, material, uvs) > 0.0f || base_color(scene, material, uvs, color).a <= 0.0f) continue;
        const glm::dvec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
        const SurfaceSample point{position, Vec3(glm::normalize(glm::cross(b - a, c - a)))};
        if (in_the_open(rays, point, mix64(seed ^ std::uint64_t(tries)))) points.push_back(point);
    }
    return points;
}

std::vector<SurfaceSample> sample_space(const RayScene& rays, const Pose& pose, int count, std::uint64_t seed) {
    const Scene& scene = rays.scene();
    if (rays.bounds().empty()) throw Error(scene.path.string(), "has no surfaces, so there is no space between them");
    FreeSpace space(rays);
    for (const Camera& camera : scene.cameras)
        space.start_at(Vec3(pose.world_from_node[std::size_t(camera.node)][3]));
    if (scene.cameras.empty()) space.start_under_the_sky();
    space.spread();

    std::vector<SurfaceSample> points;
    Random random(seed, 0, 0);
    for (long tries = 0; points.size() < std::size_t(count); ++tries) {
        if (tries > long(count) * kTriesPerPoint)
            throw Error(scene.path.string(), scene.cameras.empty()
                                                 ? "no free space found under the open sky; add a camera inside"
                                                 : "no free space found from its cameras; are they inside walls?");
        const Vec3 share(random.next(), random.next(), random.next());
        const Vec3 place = space.box().min + share * (space.box().max - space.box().min);
        const Vec3 normal = uniform_direction(random);
        if (space.reachable(place)) points.push_back({place, normal});
    }
    return points;
}

}  // namespace daylit
