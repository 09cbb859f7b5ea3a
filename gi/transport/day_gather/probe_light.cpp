#include "gi/transport/day_gather/probe_light.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "gi/transport/day_gather/sequence.h"
#include "gi/transport/day_gather/streams.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr float kSphere = 4.0f * kPiF;  // its solid angle
constexpr float kLeastCosine = 0.05f;
constexpr float kApart = 0.381966f;  // of a turn, between the halves of a probe's rays: the golden angle
constexpr int kBatch = 64;           // rays whose rows are multiplied at once
constexpr std::size_t kCoefficients = glsl::kShCoefficients;

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Even over the sphere: u.x and u.y in [0, 1).
Vec3 sample_sphere(const Vec2& u) {
    const float cosine = 1.0f - 2.0f * u.x;
    return direction_around_z(cosine, std::sqrt(std::max(1.0f - cosine * cosine, 0.0f)), u.y);
}

/// Gradients in space of the polynomials of glsl::sh_basis().
std::array<Vec3, 9> sh_basis_change(const Vec3& d) {
    constexpr float k1 = 0.488602512f, k2 = 1.092548431f, k20 = 0.315391565f, k22 = 0.546274215f;
    return {Vec3(0.0f),
            k1 * Vec3(0, 1, 0),
            k1 * Vec3(0, 0, 1),
            k1 * Vec3(1, 0, 0),
            k2 * Vec3(d.y, d.x, 0),
            k2 * Vec3(0, d.z, d.y),
            k20 * Vec3(0, 0, 6 * d.z),
            k2 * Vec3(d.z, 0, d.x),
            k22 * Vec3(2 * d.x, -2 * d.y, 0)};
}

}  // namespace

std::array<std::array<float, 9>, 4> sh_weights(const Vec3& direction, float solid_angle, float distance,
                                               const Vec3& normal) {
    std::array<std::array<float, 9>, 4> weights{};
    const glsl::Sh9 basis = glsl::sh_basis(direction);
    for (std::size_t i = 0; i < kCoefficients; ++i) weights[0][i] = solid_angle * basis.c[i];
    if (normal == Vec3(0.0f)) return weights;
    const float cosine = std::max(std::abs(glm::dot(normal, direction)), kLeastCosine);
    const Vec3 facing = glm::dot(normal, direction) > 0.0f ? -normal : normal;
    const float per_metre = solid_angle / distance;
    const Vec3 of_angle = per_metre * (3.0f * direction + facing / cosine);
    const std::array<Vec3, 9> change = sh_basis_change(direction);
    for (std::size_t i = 0; i < kCoefficients; ++i) {
        const Vec3 across = change[i] - glm::dot(change[i], direction) * direction;
        const Vec3 sum = basis.c[i] * of_angle - per_metre * across;
        for (std::size_t a = 0; a < 3; ++a) weights[1 + a][i] = sum[glm::length_t(a)];
    }
    return weights;
}

/// Rays on their way into the sums.
struct ProbeGather::Batch {
    Batch(int part_count, std::size_t components)
        : parts(part_count), weights(part_count * int(kCoefficients), kBatch), rows(kBatch, 3 * int(components)) {}

    void add(const std::array<std::array<float, 9>, 4>& w, const Rgb* row) {
        for (int part = 0; part < parts; ++part)
            for (int i = 0; i < int(kCoefficients); ++i)
                weights(part * int(kCoefficients) + i, count) = w[std::size_t(part)][std::size_t(i)];
        std::copy_n(&row->x, rows.cols(), rows.row(count).data());
        ++count;
    }
    void flush(RowMatrix& sum) {
        sum.noalias() += weights.leftCols(count) * rows.topRows(count);
        count = 0;
    }

    int parts, count = 0;
    RowMatrix weights, rows;
};

ProbeGather::ProbeGather(const GatherScene& scene, const GatherHits& hits, const LeavingLight& light)
    : scene_(scene),
      light_(light),
      receivers_(hits.receivers.size()),
      sight_(scene),
      back_(scene.texels.count(), kNoLight) {
    for (std::uint32_t r = std::uint32_t(scene.texels.count()); r < hits.receivers.size(); ++r)
        back_[hits.receivers[r].texel] = r;
}

std::uint32_t ProbeGather::row(const Ray& ray, const Hit& met) const {
    const std::uint32_t texel = texel_at(scene_, ray, met);
    if (texel == kNoTexel) return kNoLight;
    return glm::dot(ray.direction, met.normal) > 0.0f ? back_[texel] : texel;
}

void ProbeGather::add_emission(const Vec3& direction, float solid_angle, float distance, const Vec3& normal, Lit lit,
                               const Rgb& radiance, int parts, std::vector<float>& to) const {
    const auto weights = sh_weights(direction, solid_angle, distance, normal);
    for (std::size_t part = 0; part < std::size_t(parts); ++part)
        for (std::size_t i = 0; i < kCoefficients; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                to[(part * glsl::kVolumeNumbers + 3 * i + c) * light_.components + light_.of(lit)] +=
                    weights[part][i] * radiance[glm::length_t(c)];
}

void ProbeGather::sample_emitters(const Vec3& place, Random& random, const ProbeSettings& settings,
                                  std::vector<float>& to) const {
    // Both ways of meeting an emitter are weighed by the power heuristic (Veach 1997).
    const int parts = settings.change == ProbeChange::OwnRays ? 4 : 1;
    for (int s = 0; s < kEmitterSamples / 2; ++s) {
        const LightSample light = sight_.emitters().sample(place, random);
        if (light.radiance == Rgb(0.0f) || !(light.pdf > 0.0f)) continue;
        const float weight = power_heuristic(float(kEmitterSamples) * light.pdf, float(settings.rays) / kSphere);
        const float share = weight * sight_.open(place, place, light) / (light.pdf * float(kEmitterSamples / 2));
        if (share > 0.0f)
            add_emission(light.direction, share, light.distance, light.normal, light.lit, light.radiance, parts, to);
    }
}

void ProbeGather::trace(const Vec3& place, std::uint64_t key, const ProbeSettings& settings, ProbeLight& out) const {
    const int parts = settings.change == ProbeChange::OwnRays ? 4 : 1;
    Random random(settings.seed, key, kProbeStream);
    const float turn_u = random.next(), turn_v = random.next();
    int backs = 0;
    double near_sum = 0.0;
    const float solid_angle = kSphere / float(settings.rays / 2);  // of a half's ray
    for (std::size_t half = 0; half < 2; ++half) {
        Batch batch(parts, light_.components);
        RowMatrix sum = RowMatrix::Zero(batch.weights.rows(), batch.rows.cols());
        out.half[half].assign(4 * std::size_t(glsl::kVolumeNumbers) * light_.components, 0.0f);
        // Each half is spread over the whole sphere, between the other's rays.
        const int rays = settings.rays / 2;
        for (int j = 0; j < rays; ++j) {
            const Vec2 u(fraction((float(j) + 0.5f * float(half)) / float(rays) + turn_u),
                         fraction(radical_inverse(std::uint32_t(j)) + kApart * float(half) + turn_v));
            const Vec3 direction = sample_sphere(u);
            Ray ray{place, direction};
            const std::optional<Hit> met = sight_.past_glass(ray, random);
            const std::uint32_t from = met ? row(ray, *met) : std::uint32_t(receivers_) + sky_bin(ray.direction);
            const float distance = met ? glm::distance(place, ray.origin + met->distance * ray.direction) : 1e9f;
            if (met) {
                backs += glm::dot(ray.direction, met->normal) > 0.0f;
                near_sum += 1.0 / double(std::max(distance, 1e-6f));
                out.nearest = std::min(out.nearest, distance);
                if (sight_.emits(*met)) {
                    const float weight = power_heuristic(float(settings.rays) / kSphere,
                                                         float(kEmitterSamples) * sight_.emitter_pdf(ray, *met));
                    add_emission(direction, weight * solid_angle, std::max(distance, 1e-6f), met->normal,
                                 sight_.lit(*met), sight_.emission(ray, *met), parts, out.half[half]);
                }
            }
            if (from == kNoLight) continue;
            batch.add(sh_weights(direction, solid_angle / kPiF, std::max(distance, 1e-6f),
                                 met && parts > 1 ? met->normal : Vec3(0.0f)),
                      light_.rows.data() + std::size_t(from) * light_.components);
            if (batch.count == kBatch) batch.flush(sum);
        }
        batch.flush(sum);
        // [part * 9 + coefficient][component * 3 + channel] as [part][coefficient * 3 + channel][component].
        for (Eigen::Index i = 0; i < sum.rows(); ++i)
            for (std::size_t r = 0; r < light_.components; ++r)
                for (std::size_t c = 0; c < 3; ++c)
                    out.half[half][(3 * std::size_t(i) + c) * light_.components + r] += sum(i, Eigen::Index(3 * r + c));
        if (!sight_.emitters().empty()) sample_emitters(place, random, settings, out.half[half]);
    }
    out.backs = float(backs) / float(settings.rays);
    if (near_sum > 0.0) out.nearness = float(double(settings.rays) / near_sum);
}

ProbeLight ProbeGather::at(const Vec3& place, std::uint64_t key, const ProbeSettings& settings) const {
    ProbeLight light;
    trace(place, key, settings, light);
    if (settings.change != ProbeChange::Differences) return light;
    const std::size_t numbers = std::size_t(glsl::kVolumeNumbers) * light_.components;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<ProbeLight, 2> beside;
        for (int up = 0; up < 2; ++up) {
            Vec3 there = place;
            there[glm::length_t(axis)] += up ? settings.step : -settings.step;
            trace(there, key, settings, beside[std::size_t(up)]);
        }
        for (std::size_t half = 0; half < 2; ++half)
            for (std::size_t i = 0; i < numbers; ++i)
                light.half[half][(1 + axis) * numbers + i] =
                    (beside[1].half[half][i] - beside[0].half[half][i]) / (2.0f * settings.step);
    }
    return light;
}

}  // namespace daylit
