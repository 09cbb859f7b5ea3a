// Rays of probes in free space, traced once and kept.
#include <algorithm>
#include <cmath>

#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/sequence.h"
#include "gi/transport/day_gather/sight.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr std::uint64_t kProbeStream = 3;  // apart from the texels' streams 0 to 2
constexpr float kMostBacks = 0.25f;        // share of rays that meet backs from which on a probe is inside something
constexpr float kSphere = 4.0f * kPiF;     // its solid angle

/// Even over the sphere: u.x and u.y in [0, 1).
Vec3 sample_sphere(const Vec2& u) {
    const float cosine = 1.0f - 2.0f * u.x;
    return direction_around_z(cosine, std::sqrt(std::max(1.0f - cosine * cosine, 0.0f)), u.y);
}

void add(std::array<ByLit, 9>& sh, Lit lit, const Rgb& radiance, const Vec3& direction) {
    const glsl::Sh9 basis = glsl::sh_basis(direction);
    for (std::size_t i = 0; i < 9; ++i) sh[i].of(lit) += basis.c[i] * radiance;
}

class ProbeRays {
  public:
    ProbeRays(const GatherScene& scene, const GatherHits& hits, const GatherSettings& settings)
        : scene_(scene), settings_(settings), sight_(scene), back_(scene.texels.count(), kNoLight) {
        for (std::uint32_t r = std::uint32_t(scene.texels.count()); r < hits.receivers.size(); ++r)
            back_[hits.receivers[r].texel] = r;
    }

    void trace(std::size_t p, ProbeHits& out, std::uint8_t& buried) const {
        Random random(settings_.seed, p, kProbeStream);
        const float turn_u = random.next(), turn_v = random.next();
        int backs = 0;
        for (int j = 0; j < out.rays; ++j) {
            const Vec2 u(fraction((float(j) + 0.5f) / float(out.rays) + turn_u),
                         fraction(radical_inverse(std::uint32_t(j)) + turn_v));
            const std::size_t i = p * std::size_t(out.rays) + std::size_t(j);
            out.direction[i] = sample_sphere(u);
            Ray ray{out.position[p], out.direction[i]};
            const std::optional<Hit> met = sight_.past_glass(ray, random);
            out.hit[i] = met ? receiver(ray, *met, backs) : kSkyBit | sky_bin(ray.direction);
            if (!met || !sight_.emits(*met)) continue;
            // Both ways of meeting an emitter are weighed by the power heuristic (Veach 1997).
            const float weight =
                power_heuristic(float(out.rays) / kSphere, float(kEmitterSamples) * sight_.emitter_pdf(ray, *met));
            add(out.emission[p], sight_.lit(*met), weight * kSphere / float(out.rays) * sight_.emission(ray, *met),
                out.direction[i]);
        }
        buried = float(backs) > kMostBacks * float(out.rays);
        if (!sight_.emitters().empty()) sample_emitters(p, random, out);
    }

  private:
    /// The receiver that a ray met; counts backs, which are the insides of solid things.
    std::uint32_t receiver(const Ray& ray, const Hit& met, int& backs) const {
        const std::uint32_t texel =
            scene_.texels.at(scene_.atlas, met.triangle, ray.origin + met.distance * ray.direction);
        const bool back = glm::dot(ray.direction, met.normal) > 0.0f;
        backs += back;
        return texel == kNoTexel ? kNoLight : back ? back_[texel] : texel;
    }

    void sample_emitters(std::size_t p, Random& random, ProbeHits& out) const {
        const Vec3& place = out.position[p];
        for (int s = 0; s < kEmitterSamples; ++s) {
            const LightSample light = sight_.emitters().sample(place, random);
            if (light.radiance == Rgb(0.0f) || !(light.pdf > 0.0f)) continue;
            const float weight = power_heuristic(float(kEmitterSamples) * light.pdf, float(out.rays) / kSphere);
            const float share = weight * sight_.open(place, place, light) / (light.pdf * float(kEmitterSamples));
            add(out.emission[p], light.lit, share * light.radiance, light.direction);
        }
    }

    const GatherScene& scene_;
    const GatherSettings& settings_;
    Sight sight_;
    std::vector<std::uint32_t> back_;  // of each texel: the receiver behind it
};

}  // namespace

ProbeHits trace_probes(const GatherScene& scene, const GatherHits& hits, std::span<const Vec3> positions, int rays,
                       const GatherSettings& settings, const StageProgress& progress) {
    ProbeHits out;
    out.rays = rays;
    out.position.assign(positions.begin(), positions.end());
    out.hit.assign(positions.size() * std::size_t(rays), kNoLight);
    out.direction.resize(out.hit.size());
    out.emission.assign(positions.size(), {});
    std::vector<std::uint8_t> buried(positions.size(), 0);  // bytes, since threads write neighbours
    const ProbeRays probe_rays(scene, hits, settings);
    for_each_parallel(positions.size(), progress, [&](std::size_t p) { probe_rays.trace(p, out, buried[p]); });
    out.buried.assign(buried.begin(), buried.end());
    return out;
}

std::vector<Rgb> gather_probe(const DaySolution& day, const ProbeHits& probes, std::size_t probe) {
    constexpr std::size_t kCoefficients = glsl::kShCoefficients;
    const std::size_t components = day.basis.components, sky = day.leaving.size() / components - kSkyBins;
    std::vector<Rgb> sh(kCoefficients * components, Rgb(0.0f));
    // Each ray stands for 4 pi / rays of solid angle; what leaves is kept as lux, pi L.
    const float scale = 4.0f / float(probes.rays);
    for (std::size_t j = probe * std::size_t(probes.rays); j < (probe + 1) * std::size_t(probes.rays); ++j) {
        const std::uint32_t hit = probes.hit[j];
        if (hit == kNoLight) continue;
        const Rgb* row = day.leaves(hit & kSkyBit ? sky + (hit & ~kSkyBit) : hit);
        const glsl::Sh9 basis = glsl::sh_basis(probes.direction[j]);
        for (std::size_t i = 0; i < kCoefficients; ++i)
            for (std::size_t r = 0; r < components; ++r) sh[i * components + r] += scale * basis.c[i] * row[r];
    }
    for (std::size_t i = 0; i < kCoefficients; ++i) {
        sh[i * components + day.basis.component_of(StillPart::Evening)] += probes.emission[probe][i].evening;
        sh[i * components + day.basis.component_of(StillPart::Lamps)] += probes.emission[probe][i].always;
    }
    return sh;
}

}  // namespace daylit
