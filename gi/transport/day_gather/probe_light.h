#pragma once
// Light at places in free space: radiance SH over the whole sphere and how it changes from place to place, gathered
// from what leaves the receivers of the day gather. Rays are traced once for all columns of light.
#include <span>
#include <vector>

#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/sight.h"
#include "shaders/shared/volume.h"

namespace daylit {

/// What leaves receivers, and after them sky bins: pi L in lux, `components` columns a row.
struct LeavingLight {
    std::size_t components = 0;
    std::span<const Rgb> rows;
    // Components to which emission is added where rays meet it.
    std::size_t always = 0, evening = 0;
    std::size_t of(Lit lit) const { return lit == Lit::Evening ? evening : always; }
};

enum class ProbeChange {
    None,        // values alone
    OwnRays,     // from the distance and normal of what the probe's rays met
    Differences  // values at six places around, by the same directions: seven times the rays; to check the other
};

struct ProbeSettings {
    int rays = 256;
    ProbeChange change = ProbeChange::OwnRays;
    float step = 0.1f;  // metres, of Differences
    std::uint64_t seed = 1;
};

/// Numbers per component: glsl::kVolumeNumbers coefficients and channels.
struct ProbeLight {
    /// Radiance SH, cd/m^2: [part][coefficient * 3 + channel][component]; part 0 the value, 1 to 3 its change per metre
    /// along x, y, z. By halves of the rays, so that their difference tells the noise.
    std::array<std::vector<float>, 2> half;
    float backs = 0.0f;     // share of rays that met the back of a face
    float nearness = 1e9f;  // harmonic mean distance of what they met, metres
    float nearest = 1e9f;   // metres
};

class ProbeGather {
  public:
    /// Everything handed over must outlive this.
    ProbeGather(const GatherScene& scene, const GatherHits& hits, const LeavingLight& light);

    /// `key` tells one probe's random numbers from another's.
    ProbeLight at(const Vec3& place, std::uint64_t key, const ProbeSettings& settings) const;

  private:
    struct Batch;
    void trace(const Vec3& place, std::uint64_t key, const ProbeSettings& settings, ProbeLight& out) const;
    void sample_emitters(const Vec3& place, Random& random, const ProbeSettings& settings,
                         std::vector<float>& to) const;
    void add_emission(const Vec3& direction, float solid_angle, float distance, const Vec3& normal, Lit lit,
                      const Rgb& radiance, int parts, std::vector<float>& to) const;
    /// Row of what a hit shows; ~0u: black.
    std::uint32_t row(const Ray& ray, const Hit& met) const;

    const GatherScene& scene_;
    const LeavingLight& light_;
    std::size_t receivers_;
    Sight sight_;
    std::vector<std::uint32_t> back_;  // of each texel: the receiver behind it
};

/// Weight of light from a solid angle in SH coefficients (part 0), and its change per metre as the place moves (parts 1
/// to 3) while the light stays on a surface with this normal at this distance:
///   grad dw = dw (3 d + n / cos) / r,   grad Y(d) = -(1 / r) (Id - d d^T) grad_S Y      with cos = -dot(n, d)
/// Silhouettes that move before what lies behind are left out; 1 / cos is clamped. normal = 0: infinitely far.
std::array<std::array<float, 9>, 4> sh_weights(const Vec3& direction, float solid_angle, float distance,
                                               const Vec3& normal);

}  // namespace daylit
