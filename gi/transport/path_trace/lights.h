#pragma once
// All that sends light into a scene, ready to be sampled: suns, environment, emissive triangles and punctual lamps.
#include <cmath>
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
    Vec3 direction;          // unit
    float distance = 1e30f;  // of the emitting point, metres
    Rgb radiance = Rgb(0);   // cd/m^2; of lamps: irradiance on a plane facing it, over the chance to be drawn
    float pdf = 0.0f;        // per solid angle; 0: a lamp, which no other strategy can find
    Vec3 normal = Vec3(0);   // of the emitting surface towards the point; zero for all others
    Lit lit = Lit::Always;   // when an emitting surface shines
};

/// 1 - cos(kSunRadius), by the half angle so that nothing cancels.
inline const float kSunCapHeight = float(2.0 * std::pow(std::sin(0.5 * kSunRadius), 2.0));

/// A disc of kSunRadius, sampled uniformly.
class SunDisc {
  public:
    explicit SunDisc(const Sun& sun);
    LightSample sample(Vec2 u) const {
        return {.direction = frame_.to_world(sample_cap(kSunCapHeight, u.x, u.y)), .radiance = radiance_, .pdf = pdf_};
    }
    bool contains(const Vec3& direction) const {
        // By the chord, |d - s|^2 = 2 (1 - cos): the dot product of two floats would blur the disc's rim.
        const Vec3 chord = direction - frame_.z;
        return glm::dot(chord, chord) <= 2.0f * kSunCapHeight;
    }
    const Vec3& direction() const { return frame_.z; }  // of its centre
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
    /// bits   64 uniform random bits; `u` uniform in [0,1)^2
    Draw sample(std::uint64_t bits, Vec2 u) const;
    /// To be called some time before sample(bits, ...).
    void prefetch(std::uint64_t bits) const { table_.prefetch(bits); }
    Rgb radiance(const Vec2& uv) const;

  private:
    const Image& map_;
    bool black_;
    /// Solid angle of one texel, were it as large as those at the horizon; others: times the sine of the polar angle.
    float texel_at_horizon_;
    double one_over_width_;
    Vec2 one_over_size_;
    AliasTable table_;  // over texels
};

// Uniform over the texel's square of the map, so that neither the map's coordinates nor the direction need an inverse
// function.
inline EnvironmentSampler::Draw EnvironmentSampler::sample(std::uint64_t bits, Vec2 u) const {
    const auto [cell, chance] = table_.sample(bits);
    __builtin_prefetch(&map_.pixels[cell]);
    // The row without a division: by a product that the half keeps away from whole numbers.
    const auto y = std::uint32_t((double(cell) + 0.5) * one_over_width_);
    const std::uint32_t x = cell - y * std::uint32_t(map_.width);
    Draw draw;
    draw.uv = (Vec2(float(x), float(y)) + u) * one_over_size_;
    const SinCos polar = sin_cos_turns(0.5f * draw.uv.y), bearing = sin_cos_turns(draw.uv.x - 0.5f);
    draw.light.direction = Vec3(polar.sine * bearing.sine, polar.cosine, -polar.sine * bearing.cosine);
    draw.light.pdf = chance / (texel_at_horizon_ * std::max(polar.sine, 1e-9f));
    return draw;
}

/// Emissive triangles, drawn by approximate power, uniformly by area.
class EmitterSampler {
  public:
    EmitterSampler(const RayScene& rays, const Materials& materials);
    bool empty() const { return table_.empty(); }
    /// bits   64 uniform random bits; `u` uniform in [0,1)^2
    LightSample sample(const Vec3& from, std::uint64_t bits, Vec2 u) const;
    LightSample sample(const Vec3& from, Random& random) const {
        const std::uint64_t bits = random.bits();
        const float u = random.next(), v = random.next();
        return sample(from, bits, {u, v});
    }
    /// Density with which sample() at a distance finds a point of this triangle under this |cosine|.
    float pdf(std::uint32_t triangle, float distance, float cosine) const;

  private:
    /// What sample() needs of a triangle, in one place in memory.
    struct Emitter {
        Vec3 corner, edge_u, edge_v, normal;
        float pdf_area;
        std::uint32_t triangle;
        Lit lit;
        bool uniform;  // `radiance` holds everywhere
        Rgb radiance;
    };
    const RayScene& rays_;
    const Materials& materials_;
    AliasTable table_;
    std::vector<Emitter> emitters_;
    std::vector<float> pdf_area_;  // one per triangle of the mesh; empty when there are no emitters
};

/// Point and spot lamps: one is drawn in proportion to what it would give this point, were nothing between.
class LampSampler {
  public:
    explicit LampSampler(std::span<const PlacedLight> lamps);
    bool empty() const { return lamps_.empty(); }
    /// u   uniform in [0,1)
    std::optional<LightSample> sample(const Vec3& from, float u) const;

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
