// Rays of every receiver, traced once and kept.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/scene/texture.h"
#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/receiver_rays.h"
#include "gi/transport/day_gather/sight.h"
#include "gi/transport/day_gather/texel_tilts.h"

namespace daylit {
namespace {

constexpr std::uint32_t kBackBit = 1u << 30;  // until the backs that are seen have receivers of their own
// A surface nearer than this share of a texel's width covers the point: a box standing on the floor.
constexpr float kCovered = 0.01f;
constexpr float kLeastUsable = 0.25f;  // share of a receiver's rays below which it is filled from neighbours instead

/// Light straight from emissive surfaces, lux, and how it changes as the normal leans, lux a radian.
struct Emitted {
    ByLit irradiance;
    std::array<ByLit, 2> tilts;

    /// weights   of light in the tilts against its share in the irradiance
    void add(Lit lit, const Rgb& light, const Vec2& weights) {
        irradiance.of(lit) += light;
        for (std::size_t axis = 0; axis < 2; ++axis) tilts[axis].of(lit) += weights[int(axis)] * light;
    }
    void add(const Emitted& other) {
        irradiance += other.irradiance;
        for (std::size_t axis = 0; axis < 2; ++axis) tilts[axis] += other.tilts[axis];
    }
    void scale(float factor) {
        irradiance *= factor;
        for (ByLit& tilt : tilts) tilt *= factor;
    }
};

/// Traces one receiver's rays, before it is known which of its points lie inside solid geometry.
class Tracer {
  public:
    Tracer(const GatherScene& scene, const GatherSettings& settings)
        : scene_(scene), settings_(settings), sight_(scene) {}

    void trace(std::size_t r, GatherHits& out) const {
        const Receiver receiver = out.receivers[r];
        ReceiverRays rays(scene_, settings_, receiver);
        const TiltFrame frame = tilt_frame(scene_, receiver.texel);
        std::uint32_t* hit = out.hit.data() + r * std::size_t(out.rays);
        std::vector<Emitted> emitted(std::size_t(out.rays));
        std::vector<float> nearness(std::size_t(out.rays), 0.0f);
        std::array<int, ReceiverRays::kMostPoints> good{};
        const float covered = kCovered * scene_.texels.width[receiver.texel];
        for (int j = 0; j < out.rays; ++j) {
            const std::size_t k = rays.point_of(j);
            const Vec3 &normal = rays.normal_of(k), direction = rays.direction(j);
            Ray ray{RayScene::offset_origin(rays.position_of(k), normal, direction), direction};
            const std::optional<Hit> met = sight_.past_glass(ray, rays.random());
            hit[j] = kSkyBit | sky_bin(ray.direction);
            good[k] += !met;
            if (!met) continue;
            const std::uint32_t texel = texel_at(scene_, ray, *met);
            const bool back = glm::dot(ray.direction, met->normal) > 0.0f;
            good[k] += !back && met->distance > covered;
            hit[j] = texel == kNoTexel ? kNoLight : texel | (back ? kBackBit : 0u);
            nearness[std::size_t(j)] = 1.0f / std::max(met->distance, 0.1f * scene_.texels.width[receiver.texel]);
            if (sight_.emits(*met))
                emitted[std::size_t(j)].add(sight_.lit(*met), emitted_towards(ray, *met, glm::dot(direction, normal)),
                                            tilt_weights(frame, normal, direction));
        }
        reduce(r, rays, frame, good, emitted, nearness, out);
    }

  private:
    /// Drops points that see nothing but backs or are covered, and sums what is left.
    void reduce(std::size_t r, ReceiverRays& rays, const TiltFrame& frame,
                const std::array<int, ReceiverRays::kMostPoints>& good, const std::vector<Emitted>& emitted,
                const std::vector<float>& nearness, GatherHits& out) const {
        std::uint32_t* hit = out.hit.data() + r * std::size_t(out.rays);
        int kept = 0;
        float near_sum = 0.0f;
        Emitted emission;
        for (int j = 0; j < out.rays; ++j) {
            if (good[rays.point_of(j)] == 0) {
                hit[j] = kNoLight;
                continue;
            }
            ++kept;
            emission.add(emitted[std::size_t(j)]);
            near_sum += nearness[std::size_t(j)];
        }
        for (std::size_t k = 0; k < rays.points(); ++k)
            if (good[k] > 0) out.usable[r] |= std::uint16_t(1u << k);
        const bool buried = float(kept) < kLeastUsable * float(out.rays);
        if (buried) std::fill(hit, hit + out.rays, kNoLight);
        out.scale[r] = buried ? 0.0f : 1.0f / float(kept);
        out.nearness[r] = near_sum > 0.0f ? float(kept) / near_sum : 1e9f;
        if (buried) return;
        emission.scale(float(kPi) * out.scale[r]);
        emission.add(sampled_emission(r, rays, frame, out));
        out.emission[r] = emission.irradiance, out.emission_tilts[r] = emission.tilts;
    }

    // Both ways of meeting an emitter are weighed by the power heuristic (Veach 1997).
    Rgb emitted_towards(const Ray& ray, const Hit& hit, float cosine) const {
        const float by_ray = float(settings_.rays) * pdf_cosine_hemisphere(cosine);
        return power_heuristic(by_ray, float(kEmitterSamples) * sight_.emitter_pdf(ray, hit)) *
               sight_.emission(ray, hit);
    }

    Emitted sampled_emission(std::size_t r, ReceiverRays& rays, const TiltFrame& frame, const GatherHits& out) const {
        Emitted sum;
        if (sight_.emitters().empty()) return sum;
        std::array<std::size_t, ReceiverRays::kMostPoints> usable;
        std::size_t count = 0;
        for (std::size_t k = 0; k < rays.points(); ++k)
            if (out.usable[r] >> k & 1u) usable[count++] = k;
        for (int s = 0; s < kEmitterSamples; ++s) {
            const std::size_t k = usable[std::min(std::size_t(rays.random().next() * float(count)), count - 1)];
            const LightSample light = sight_.emitters().sample(rays.position_of(k), rays.random());
            sum.add(light.lit, from_sample(rays.position_of(k), rays.normal_of(k), light),
                    tilt_weights(frame, rays.normal_of(k), light.direction));
        }
        sum.scale(1.0f / float(kEmitterSamples));
        return sum;
    }

    Rgb from_sample(const Vec3& p, const Vec3& n, const LightSample& light) const {
        const float cosine = glm::dot(light.direction, n);
        if (light.radiance == Rgb(0.0f) || !(light.pdf > 0.0f) || cosine <= 0.0f) return Rgb(0.0f);
        const Vec3 origin = RayScene::offset_origin(p, n, light.direction);
        const float open = sight_.open(origin, p, light);
        const float weight =
            power_heuristic(float(kEmitterSamples) * light.pdf, float(settings_.rays) * pdf_cosine_hemisphere(cosine));
        return weight * open * cosine / light.pdf * light.radiance;
    }

    const GatherScene& scene_;
    const GatherSettings& settings_;
    Sight sight_;
};

/// Appends receivers with room for their rays.
void add_receivers(const std::vector<Receiver>& more, GatherHits& hits) {
    hits.receivers.insert(hits.receivers.end(), more.begin(), more.end());
    const std::size_t count = hits.receivers.size();
    hits.hit.resize(count * std::size_t(hits.rays), kNoLight);
    hits.scale.resize(count, 0.0f);
    hits.usable.resize(count, 0);
    hits.nearness.resize(count, 0.0f);
    hits.emission.resize(count);
    hits.emission_tilts.resize(count);
}

constexpr std::size_t kBlock = 8192;  // receivers that are kept together

/// What is traced of the receivers [first, last), as bytes.
template <class Byte, class Hits>
std::array<std::span<Byte>, 6> block_of(Hits& hits, std::size_t first, std::size_t last) {
    const auto bytes = [&](auto& values, std::size_t each) {
        const auto part = std::span(values).subspan(first * each, (last - first) * each);
        return std::span<Byte>(reinterpret_cast<Byte*>(part.data()), part.size_bytes());
    };
    return {bytes(hits.hit, std::size_t(hits.rays)),
            bytes(hits.scale, 1),
            bytes(hits.usable, 1),
            bytes(hits.nearness, 1),
            bytes(hits.emission, 1),
            bytes(hits.emission_tilts, 1)};
}

/// Charts whose backs are met, from receivers `first` on, by more rays than chance cracks let through.
std::vector<std::uint32_t> charts_seen_from_behind(const GatherScene& scene, const GatherHits& hits, std::size_t first,
                                                   const std::vector<bool>& known) {
    std::vector<std::uint32_t> met(scene.atlas.charts.size(), 0), size(met.size(), 0), result;
    for (std::uint32_t chart : scene.texels.chart) ++size[chart];
    for (std::size_t i = first * std::size_t(hits.rays); i < hits.hit.size(); ++i) {
        const std::uint32_t h = hits.hit[i];
        if (!(h & kSkyBit) && (h & kBackBit)) ++met[scene.texels.chart[h & ~kBackBit]];
    }
    for (std::uint32_t c = 0; c < met.size(); ++c)
        if (!known[c] && met[c] > 4 + size[c] / 4) result.push_back(c);
    return result;
}

/// Turns texel-and-side into receivers.
void resolve(const GatherScene& scene, GatherHits& hits) {
    std::vector<std::uint32_t> back(scene.texels.count(), kNoLight);
    for (std::uint32_t r = std::uint32_t(scene.texels.count()); r < hits.receivers.size(); ++r)
        back[hits.receivers[r].texel] = r;
    for (std::uint32_t& h : hits.hit)
        if (!(h & kSkyBit) && (h & kBackBit)) h = back[h & ~kBackBit];
}

}  // namespace

GatherScene gather_scene(const RayScene& rays, const Atlas& atlas, const Texels& texels,
                         std::span<const PlacedLight> lamps) {
    GatherScene scene{rays, atlas, texels, lamps, std::vector<Rgb>(texels.count()), std::vector<float>(texels.count())};
    const WorldMesh& mesh = rays.mesh();
    const StageProgress silent{Progress{}};
    const std::vector<Material>& materials = rays.scene().materials;
    std::vector<float> evenness(materials.size());
    for_each_parallel(
        materials.size(), silent, [&](std::size_t m) { evenness[m] = mean_cosine(rays.scene(), materials[m]); }, 1);
    for_each_parallel(texels.count(), silent, [&](std::size_t i) {
        const auto points = texels.points_of(i);
        Rgb sum(0.0f);
        float even = 0.0f;
        for (const TexelPoint& p : points) {
            const std::uint32_t* c = &mesh.indices[3 * std::size_t(p.triangle)];
            const Vec3 w(1.0f - p.barycentric.x - p.barycentric.y, p.barycentric.x, p.barycentric.y);
            std::array<Vec2, 2> uvs;
            for (std::size_t set = 0; set < 2; ++set)
                uvs[set] = mesh.uvs[c[0]][set] * w.x + mesh.uvs[c[1]][set] * w.y + mesh.uvs[c[2]][set] * w.z;
            const Rgba color = mesh.colors[c[0]] * w.x + mesh.colors[c[1]] * w.y + mesh.colors[c[2]] * w.z;
            const glsl::Brdf brdf =
                surface_brdf(rays.scene(), rays.scene().materials[mesh.materials[p.triangle]], uvs, color);
            sum += glm::clamp(glsl::mean_albedo(brdf), Rgb(0.0f), Rgb(1.0f));
            even += evenness[mesh.materials[p.triangle]];
        }
        scene.albedo[i] = sum / float(points.size());
        scene.evenness[i] = even / float(points.size());
    });
    return scene;
}

GatherHits trace_hits(const GatherScene& scene, const GatherSettings& settings, Checkpoint& checkpoint,
                      const StageProgress& progress) {
    const Tracer tracer(scene, settings);
    GatherHits hits;
    hits.rays = settings.rays;
    std::vector<Receiver> fresh;
    for (std::uint32_t t = 0; t < scene.texels.count(); ++t) fresh.push_back({t, false});
    std::vector<bool> has_back(scene.atlas.charts.size(), false);
    double begin = 0.0;
    while (!fresh.empty()) {
        const std::size_t first = hits.receivers.size();
        add_receivers(fresh, hits);
        const double end = begin == 0.0 ? 0.8 : 1.0;
        const StageProgress pass = progress.part(begin, end);
        for (std::size_t at = first; at < hits.receivers.size(); at += kBlock) {
            const std::size_t last = std::min(at + kBlock, hits.receivers.size());
            const auto share = [&](std::size_t r) { return double(r - first) / double(fresh.size()); };
            if (checkpoint.load(at, block_of<std::byte>(hits, at, last))) continue;
            for_each_parallel(last - at, pass.part(share(at), share(last)),
                              [&](std::size_t i) { tracer.trace(at + i, hits); });
            checkpoint.store(at, block_of<const std::byte>(hits, at, last));
        }
        begin = end;
        for (std::uint32_t c : charts_seen_from_behind(scene, hits, first, has_back)) has_back[c] = true;
        fresh.clear();
        for (std::uint32_t t = 0; t < scene.texels.count(); ++t)
            if (has_back[scene.texels.chart[t]]) fresh.push_back({t, true});
        if (hits.receivers.size() > scene.texels.count()) {  // those that have receivers already
            std::vector<bool> done(scene.texels.count(), false);
            for (std::size_t r = scene.texels.count(); r < hits.receivers.size(); ++r)
                done[hits.receivers[r].texel] = true;
            std::erase_if(fresh, [&](const Receiver& r) { return done[r.texel]; });
        }
    }
    resolve(scene, hits);
    return hits;
}

}  // namespace daylit
