#pragma once
// One path at a time: what one sample of a pixel or of a point sees.
#include <cstdint>

#include "gi/transport/path_trace/bsdf.h"
#include "gi/transport/path_trace/lights.h"
#include "gi/transport/path_trace/materials.h"
#include "gi/transport/path_trace/path_random.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {

class Integrator {
  public:
    /// All that is passed in must outlive it; thread-safe afterwards.
    Integrator(const RayScene& rays, const Lighting& lighting, std::span<const PlacedLight> lamps,
               const PathTraceSettings& settings);

    struct Sample {
        Rgb value = Rgb(0.0f);
        std::uint32_t rays = 0;
    };
    /// One sample of settings.layer along a camera ray.
    Sample camera_sample(const ViewRay& ray, PathRandom& random) const;
    /// One sample of the irradiance at a point, lux: Layer::Final all light, else only the indirect part.
    Sample irradiance_sample(const SurfaceSample& point, PathRandom& random) const;

  private:
    struct Path;
    struct FoundSurface {
        Hit hit;
        Ray ray;  // that hit it; the distance to the eye is `travelled` + hit.distance
        float travelled = 0.0f;
    };

    std::optional<FoundSurface> first_surface(const Ray& camera_ray, PathRandom& random, std::uint32_t& count) const;
    Rgb surface_layer(const SurfacePoint& point) const;
    void trace(Path& path, Ray& ray) const;
    bool meet(Path& path, Ray& ray, const Hit& hit) const;
    void plan_sky(Path& path) const;
    void add_background(Path& path, const Vec3& direction) const;
    void add_emission(Path& path, const Ray& ray, const Hit& hit, const SurfacePoint& point) const;
    void pass_glass(Path& path, Ray& ray, const Hit& hit, const SurfacePoint& point) const;
    bool scatter(Path& path, Ray& ray, const Vec3& position, const Vec3& geometric_normal,
                 const Reflection& reflection) const;
    void add_straight_light(Path& path, const Vec3& position, const Vec3& geometric_normal,
                            const Reflection& reflection) const;
    void add_area_light(Path& path, const Vec3& position, const Vec3& geometric_normal,
                        const Reflection& reflection) const;
    float visibility(Path& path, const Vec3& position, const Vec3& geometric_normal, const LightSample& sample) const;
    bool sun_in(const Vec3& direction) const;
    bool survives(Path& path) const;

    const RayScene& rays_;
    PathTraceSettings settings_;
    Materials materials_;
    Lights lights_;
    std::vector<bool> panes_;  // empty: no glass
    bool want_direct_, want_indirect_;
};

}  // namespace daylit
