#include "gi/surface/surroundings.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/base/random.h"
#include "gi/surface/charts.h"
#include "gi/transport/path_trace/materials.h"
#include "gi/transport/path_trace/sampling.h"

namespace daylit {
namespace {

constexpr int kLooks = 8;            // rays from a point
constexpr int kPanes = 8;            // of glass that a ray goes through, straight on
constexpr float kCovered = 0.01f;    // of the spacing
constexpr float kMinSlant = 0.1f;    // of a ray with what it meets, in gradients
constexpr float kMostPoints = 1e7f;  // of a triangle

/// From one point.
struct Outlook {
    bool open = false;  // sees the sky, or the front of something that does not lie upon it
    double nearness = 0.0;
    glm::dvec3 gradient = glm::dvec3(0.0);  // of nearness, along the surface
};

class Onlooker {
  public:
    Onlooker(const RayScene& rays, float spacing) : rays_(rays), materials_(rays.scene()), spacing_(spacing) {}

    Surroundings around(std::uint32_t triangle, const Facet& facet) const {
        for (const float side : {1.0f, -1.0f})
            if (const Surroundings seen = around(triangle, facet.area, side * facet.normal); !seen.hidden) return seen;
        return {.hidden = true};
    }

  private:
    Surroundings around(std::uint32_t triangle, float area, const Vec3& normal) const {
        Random random(0, triangle, 0);
        const auto points = 1 + std::size_t(std::min(area / (spacing_ * spacing_), kMostPoints));
        double nearness = 0.0, open = 0.0;
        glm::dmat3 change(0.0);
        for (std::size_t i = 0; i < points; ++i) {
            const Outlook outlook = look(any_point(triangle, random), normal, random);
            if (!outlook.open) continue;
            ++open;
            nearness += outlook.nearness;
            if (const double steepness = glm::length(outlook.gradient); steepness > 0.0)
                change += glm::outerProduct(outlook.gradient, outlook.gradient / steepness);
        }
        if (open == 0.0) return {.hidden = true};
        return {float(nearness / open), Mat3(change / open), false};
    }

    Vec3 any_point(std::uint32_t triangle, Random& random) const {
        const float root = std::sqrt(random.next()), share = random.next();
        const Vec3 weights(1.0f - root, root * (1.0f - share), root * share);
        const std::uint32_t* corner = &rays_.mesh().indices[3 * std::size_t(triangle)];
        Vec3 place(0.0f);
        for (int k = 0; k < 3; ++k) place += weights[k] * rays_.mesh().positions[corner[k]];
        return place;
    }

    Outlook look(const Vec3& place, const Vec3& normal, Random& random) const {
        const Frame frame(normal);
        Outlook outlook;
        for (int i = 0; i < kLooks; ++i) {
            const float u = (float(i) + random.next()) / float(kLooks), v = random.next();
            const Vec3 direction = frame.to_world(sample_cosine_hemisphere(u, v));
            const Ray ray{RayScene::offset_origin(place, normal, direction), direction};
            const std::optional<Hit> hit = past_glass(ray, random);
            const float cosine = hit ? glm::dot(direction, hit->normal) : -1.0f;
            outlook.open |= !hit || (cosine < 0.0f && hit->distance > kCovered * spacing_);
            if (!hit) continue;
            const double inverse = 1.0 / double(std::max(hit->distance, spacing_));
            outlook.nearness += inverse / kLooks;
            // A plane with this normal at distance r = ((q - p).n) / (w.n): the gradient of 1 / r by p.
            const double slant = std::copysign(std::max(std::abs(cosine), kMinSlant), cosine);
            outlook.gradient += inverse * inverse / (slant * kLooks) * glm::dvec3(hit->normal);
        }
        outlook.gradient -= glm::dot(outlook.gradient, glm::dvec3(normal)) * glm::dvec3(normal);
        return outlook;
    }

    std::optional<Hit> past_glass(Ray ray, Random& random) const {
        const std::uint64_t key = random.bits();
        const auto glass = [&](const Hit& hit) {
            return materials_.glass(rays_.mesh().materials[hit.triangle]) &&
                   materials_.meets_glass(rays_.surface_point(ray, hit), random);
        };
        std::optional<Hit> hit = rays_.closest(ray, key);
        for (int pane = 0; hit && glass(*hit) && pane < kPanes; ++pane) {
            ray.t_min = std::nextafter(hit->distance, INFINITY);
            hit = rays_.closest(ray, key);
        }
        return hit;
    }

    const RayScene& rays_;
    Materials materials_;
    float spacing_;
};

}  // namespace

std::vector<Surroundings> look_around(const RayScene& rays, float spacing) {
    const std::vector<Facet> facet = facets(rays.mesh());
    const Onlooker onlooker(rays, spacing);
    std::vector<Surroundings> result(facet.size());
    tbb::parallel_for(std::size_t(0), facet.size(), [&](std::size_t t) {
        if (facet[t].area > 0.0f) result[t] = onlooker.around(std::uint32_t(t), facet[t]);
    });
    return result;
}

}  // namespace daylit
