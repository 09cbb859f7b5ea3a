#pragma once
// All that sends light into a scene, ready to be sampled: suns, environment, emissive triangles and punctual lamps.
#include <optional>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "engine/scene/sky.h"
#include "gi/trace/ray_scene.h"
#include "gi/transport/path_trace/alias_table.h"
#include "gi/transport/path_trace/materials.h"
#include "gi/transport/path_trace/sampling.h"

namespace daylit {

/// Light that may reach a point from one direction.
struct LightSample {
    Vec3 direction;         // unit
    float distance = 1e30f;  // of the emitting point, metres
    Rgb radiance = Rgb(0);   // cd/m^2; of lamps: irradiance on a plane facing it, over the chance to be drawn
    float pdf = 0.0f;        // per solid angle; 0: a lamp, which no other strategy can find
    Vec3 normal = Vec3(0);   // of the emitting surface towards the point; zero for all others
    Lit lit = Lit::Always;   // when an emitting surface shines
};

/// A disc of kSunRadius, sampled uniformly.
class SunDisc {
  public:
    explicit SunDisc(const Sun& sun);
    LightSample sample(float u, float v) const;
    bool contains(const Vec3& direction) const;
    const Rgb& radiance() const { return radiance_; }
    float pdf() const { return pdf_; }

  private:
    Frame frame_;
    Rgb radiance_;
    float pdf_;
};

/// The sky, sampled in proportion to what bilinear filtering makes of each texel. A constant or black one is left to
/// the BRDF's own sampling, which does it as well and needs no rays.
class EnvironmentSampler {
  public:
    explicit EnvironmentSampler(const Environment& sky);
    bool black() const { return black_; }
    bool samplable() const { return !table_.empty(); }

    /// As Environment::radiance, in single precision, together with the density of sample().
    struct Seen {
        Rgb radiance;
        float pdf;
    };
    Seen look(const Vec3& direction) const;

    /// Without its radiance, which costs more: to be asked for when the direction turns out to matter.
    struct Draw {
        LightSample light;
        Vec2 uv;
    };
    Draw sample(Random& random) const;
    Rgb radiance(const Vec2& uv) const;

  private:
    const Image& map_;
    bool black_;
    AliasTable table_;                  // over texels
    std::vector<float> row_edge_cos_;   // cosine of the polar angle between the rows; one more than there are rows
    std::vector<float> row_solid_angle_;  // of a texel in each row
};

/// Emissive triangles, drawn by approximate power, uniformly by area.
class EmitterSampler {
  public:
    EmitterSampler(const RayScene& rays, const Materials& materials);
    bool empty() const { return table_.empty(); }
    LightSample sample(const Vec3& from, Random& random) const;
    /// Density with which sample() at a distance finds a point of this triangle under this |cosine|.
    float pdf(std::uint32_t triangle, float distance, float cosine) const;

  private:
    const RayScene& rays_;
    const Materials& materials_;
    AliasTable table_;
    std::vector<std::uint32_t> triangles_;
    std::vector<float> pdf_area_;      // one per triangle of the mesh; empty when there are no emitters
};

/// Point and spot lamps: one is drawn in proportion to what it would give this point, were nothing between.
class LampSampler {
  public:
    explicit LampSampler(std::span<const PlacedLight> lamps);
    bool empty() const { return lamps_.empty(); }
    std::optional<LightSample> sample(const Vec3& from, Random& random) const;

  private:
    std::vector<PlacedLight> lamps_;
};

struct Lights {
    Lights(const RayScene& rays, const Materials& materials, const Lighting& lighting,
           std::span<const PlacedLight> lamps);
    std::vector<SunDisc> suns;
    EnvironmentSampler sky;
    EmitterSampler emitters;
    LampSampler lamps;
};

}  // namespace daylit
