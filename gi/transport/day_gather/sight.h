#pragma once
// What a gather ray meets, and light sampled from emissive surfaces; the same for texels and probes.
#include <optional>
#include <vector>

#include "engine/base/random.h"
#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/path_trace/lights.h"
#include "gi/transport/path_trace/materials.h"

namespace daylit {

/// The texel that a ray met; kNoTexel where the surface has none.
std::uint32_t texel_at(const GatherScene& scene, const Ray& ray, const Hit& hit);

inline constexpr int kEmitterSamples = 8;  // per receiver

class Sight {
  public:
    explicit Sight(const GatherScene& scene);

    /// The nearest surface that is not glass; ray becomes its last stretch. The tint of glass decides by chance, in
    /// luminance, whether light comes through: its colour is left to the reference and to the caustics to come.
    std::optional<Hit> past_glass(Ray& ray, Random& random) const;

    /// Radiance of the surface that a ray met.
    Rgb emission(const Ray& ray, const Hit& hit) const;
    /// Density, per solid angle, with which emitters().sample() finds what this ray met; 0: it does not shine.
    float emitter_pdf(const Ray& ray, const Hit& hit) const;
    bool emits(const Hit& hit) const { return materials_.emits(scene_.rays.mesh().materials[hit.triangle]); }
    Lit lit(const Hit& hit) const {
        return scene_.rays.scene().materials[scene_.rays.mesh().materials[hit.triangle]].lit;
    }
    const EmitterSampler& emitters() const { return emitters_; }
    /// Share of a sampled emitter's light that arrives at `origin`.
    float open(const Vec3& origin, const Vec3& from, const LightSample& light) const;

  private:
    const GatherScene& scene_;
    Materials materials_;
    EmitterSampler emitters_;
    std::vector<bool> panes_;
};

}  // namespace daylit
