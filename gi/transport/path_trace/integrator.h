#pragma once
// A few paths at a time that start close together: what samples of one pixel or of one point see.
#include <cstdint>
#include <span>

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

    /// How many paths go together at most.
    static constexpr std::size_t kWave = RayScene::kBundle;

    struct Sample {
        Rgb value = Rgb(0.0f);
        std::uint32_t rays = 0;
    };
    struct CameraStart {
        ViewRay ray;
        PathRandom random;
    };
    /// Samples of settings.layer along camera rays, at most kWave and close together: they are traced as one bundle.
    void camera_samples(std::span<CameraStart> starts, std::span<Sample> samples) const;
    /// Samples of the irradiance at a point, lux, at most kWave: Layer::Final all light, else only the indirect part.
    void irradiance_samples(const SurfaceSample& point, std::span<PathRandom> randoms, std::span<Sample> samples) const;

  private:
    struct Path;
    struct Shadow;
    struct Shadows;
    struct Wave;
    struct FoundSurface {
        Hit hit;
        Ray ray;  // that hit it; the distance to the eye is `travelled` + hit.distance
        float travelled = 0.0f;
    };

    void follow(Path& path, const Ray& camera_ray, const std::optional<Hit>& hit) const;
    std::optional<FoundSurface> first_surface(Path& path, const Ray& camera_ray, std::optional<Hit> hit) const;
    Rgb surface_layer(const SurfacePoint& point) const;
    void irradiate(Path& path, const Vec3& position, const Vec3& geometric_normal, const Vec3& shading_normal) const;
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
    void cast_shadow(Path& path, Shadows& shadows, const Vec3& position, const Vec3& geometric_normal,
                     const LightSample& sample, const Shadow& shadow) const;
    void add_unshadowed(Path& path, const Shadow& shadow, float through) const;
    void trace_shadows(Shadows& shadows) const;
    void finish(Wave& wave, std::span<Sample> samples) const;
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
