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

    bool glass(std::uint32_t material) const { return constants_[material].glass; }
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
        bool plain_brdf = false;  // no texture: `brdf` holds where the vertex colour is white
        glsl::Brdf brdf{};
    };
    const Scene& scene_;
    std::vector<Constants> constants_;
};

}  // namespace daylit
