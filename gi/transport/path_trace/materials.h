#pragma once
// Materials of a scene as paths meet them; what does not vary over a surface is worked out once.
#include <cstdint>
#include <vector>

#include "engine/scene/texture.h"
#include "gi/trace/ray_scene.h"

namespace daylit {

class Materials {
  public:
    /// evening   share of their light that emitters lit in the evening give
    explicit Materials(const Scene& scene, float evening = 1.0f);

    /// Whether some of it is glass.
    bool glass(std::uint32_t material) const { return constants_[material].glass; }
    /// Whether light meets glass at a point, or the opaque rest: by chance, as their shares are. A number is drawn only
    /// where both may be met.
    template <class Random>
    bool meets_glass(const SurfacePoint& point, Random& random) const {
        if (!glass(point.material)) return false;
        const float share = transmission(scene_, scene_.materials[point.material], point.uvs);
        return share >= 1.0f || (share > 0.0f && random.next() < share);
    }
    bool emits(std::uint32_t material) const { return constants_[material].emits; }
    bool unlit(std::uint32_t material) const { return constants_[material].unlit; }

    glsl::Brdf brdf(const SurfacePoint& point) const;
    /// Base colour without coverage: the tint of glass, the radiance of unlit surfaces.
    Rgb color(const SurfacePoint& point) const;
    /// Radiance in cd/m^2 that leaves to both sides, of what is there (coverage is the tracer's business).
    Rgb emission(const SurfacePoint& point) const;
    /// The same times coverage, at a point of a triangle: what a ray towards it finds on average.
    Rgb covered_emission(const WorldMesh& mesh, std::uint32_t triangle, const Vec2& barycentric) const;

  private:
    struct Constants {
        bool glass = false, emits = false, unlit = false;
        float shining = 1.0f;     // share of its emission, by its hours
        bool plain_brdf = false;  // no texture of it: `brdf` holds where the vertex colour is white
        glsl::Brdf brdf{};
    };
    const Scene& scene_;
    std::vector<Constants> constants_;
};

}  // namespace daylit
