#pragma once
// The only door to Embree: closest hits and transmittance in a WorldMesh. No other folder includes Embree.
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/scene/pose.h"

namespace daylit {

struct Ray {
    Vec3 origin;
    Vec3 direction;  // unit
    float t_min = 0.0f;
    float t_max = 1e30f;
};

struct Hit {
    float distance = 0.0f;        // metres
    std::uint32_t triangle = 0;   // in the WorldMesh
    Vec2 barycentric = Vec2(0);   // weights of the triangle's second and third corner
    Vec3 normal = Vec3(0, 1, 0);  // geometric, unit, by the triangle's winding (not turned towards the ray)
};

/// Everything a hit point needs for shading; interpolated from the WorldMesh.
struct SurfacePoint {
    Vec3 position;
    Vec3 geometric_normal;  // unit, turned to the side the ray came from
    Vec3 shading_normal;    // unit, same side; normal map included
    std::array<Vec2, 2> uvs;
    Rgba color;  // vertex colour
    std::uint32_t material;
};

/// Immutable after construction; all queries are thread-safe and deterministic for any number of threads (medium build
/// quality, robust intersection; of opaque triangles with the same corners the lowest index is kept, other ties follow
/// the order of a hierarchy that is always built alike).
/// The scene and mesh must outlive it. Triangles of zero area and with non-finite corners are left out.
class RayScene {
  public:
    RayScene(const Scene& scene, const WorldMesh& mesh);
    ~RayScene();
    RayScene(RayScene&&) noexcept;

    const Scene& scene() const;
    const WorldMesh& mesh() const;
    Bounds bounds() const;
    /// False for triangles left out: no area, corners that are not finite, cut out or clear everywhere, or the twin of
    /// an earlier opaque one.
    bool traced(std::uint32_t triangle) const;
    /// Geometric normal by winding, unit; zero where the triangle has none.
    const Vec3& normal(std::uint32_t triangle) const;

    /// The nearest surface, coverage ignored except MASK (cut-out texels are never hit).
    /// BLEND surfaces are passed with probability 1 - alpha by a hash of (key, triangle): unbiased coverage. Pass a
    /// different key for every ray.
    std::optional<Hit> closest(const Ray& ray, std::uint64_t key) const;

    /// Share of light let through between the ray's ends: 0 blocked; MASK cut-outs let all, BLEND 1 - alpha each.
    float transmittance(const Ray& ray) const;

    /// How many rays may be traced together.
    static constexpr std::size_t kBundle = 8;
    /// closest() of rays that lie close together, as those through one pixel; at most kBundle.
    void closest(std::span<const Ray> rays, std::span<const std::uint64_t> keys,
                 std::span<std::optional<Hit>> hits) const;
    /// transmittance() of several rays, at most kBundle; the closer together, the faster.
    void transmittance(std::span<const Ray> rays, std::span<float> shares) const;

    SurfacePoint surface_point(const Ray& ray, const Hit& hit) const;

    /// Start of a ray that leaves a surface point: moved off the plane along the geometric normal (on the side of
    /// `direction`) by an amount that scales with the coordinates (Waechter and Binder 2019).
    static Vec3 offset_origin(const Vec3& position, const Vec3& geometric_normal, const Vec3& direction) {
        // 256 units in the last place, and an absolute step near the origin, where those would vanish.
        constexpr float kNearOrigin = 1.0f / 32.0f, kAbsoluteStep = 1.0f / 65536.0f, kUnits = 256.0f;
        const float side = glm::dot(geometric_normal, direction) < 0.0f ? -1.0f : 1.0f;
        Vec3 moved;
        for (int axis = 0; axis < 3; ++axis) {
            const float p = position[axis], n = side * geometric_normal[axis];
            const int units = int(kUnits * n);
            moved[axis] = std::abs(p) < kNearOrigin
                              ? p + kAbsoluteStep * n
                              : std::bit_cast<float>(std::bit_cast<std::int32_t>(p) + (p < 0.0f ? -units : units));
        }
        return moved;
    }

    /// Appends every ray of closest() and transmittance() to `log` from now on; null stops it. For benchmarks: while
    /// rays are logged, only one thread may trace.
    void log_rays(std::vector<Ray>* log);

  private:
    struct State;
    void log(const Ray& ray) const;

    std::unique_ptr<State> state_;
};

}  // namespace daylit
