#include "gi/transport/path_trace/lights.h"

#include <cmath>

namespace daylit {
namespace {

/// Integral of the bilinear map's luminance over each texel's square, in units of one texel's area: along each axis
/// the tent of a texel puts 6/8 inside its own square and 1/8 in each neighbour's.
std::vector<double> bilinear_texel_means(const Image& map) {
    const auto w = std::size_t(map.width), h = std::size_t(map.height);
    std::vector<double> rows(w * h), means(w * h);
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x) {
            const Rgb* row = &map.pixels[y * w];
            rows[y * w + x] = 0.125 * luminance(row[(x + w - 1) % w]) + 0.75 * luminance(row[x]) +
                              0.125 * luminance(row[(x + 1) % w]);
        }
    for (std::size_t y = 0; y < h; ++y)
        for (std::size_t x = 0; x < w; ++x)
            means[y * w + x] = 0.125 * rows[(y > 0 ? y - 1 : 0) * w + x] + 0.75 * rows[y * w + x] +
                               0.125 * rows[std::min(y + 1, h - 1) * w + x];
    return means;
}

double triangle_area(const WorldMesh& mesh, std::size_t triangle) {
    const std::uint32_t* corner = &mesh.indices[3 * triangle];
    const glm::dvec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

/// Luminance of a triangle's emission, averaged over a fixed grid of points; a little of the untextured emission is
/// added, so that small bright spots between the points keep a chance.
double mean_emission(const RayScene& rays, const Materials& materials, std::uint32_t triangle) {
    const Material& material = rays.scene().materials[rays.mesh().materials[triangle]];
    constexpr int kSide = 4;
    double sum = 0.0;
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const Vec2 b = sample_triangle((float(i) + 0.5f) / kSide, (float(j) + 0.5f) / kSide);
            sum += luminance(materials.covered_emission(rays.mesh(), triangle, b));
        }
    return sum / (kSide * kSide) + 1e-3 * luminance(material.emission);
}

}  // namespace

SunDisc::SunDisc(const Sun& sun)
    : frame_(sun.direction), radiance_(disc_radiance(sun)), pdf_(pdf_cap(kSunCapHeight)) {}

EnvironmentSampler::EnvironmentSampler(const Environment& sky)
    : map_(sky.map),
      black_(sky.map.empty() || sky.black()),
      texel_at_horizon_(black_ ? 0.0f : float(2.0 * kPi / sky.map.width * kPi / sky.map.height)),
      one_over_width_(1.0 / std::max(sky.map.width, 1)),
      one_over_size_(one_over_width_, 1.0 / std::max(sky.map.height, 1)) {
    if (black_ || sky.constant()) return;
    const auto w = std::size_t(map_.width), h = std::size_t(map_.height);
    std::vector<double> weights = bilinear_texel_means(map_);
    for (std::size_t y = 0; y < h; ++y) {
        const double sine = std::sin(kPi * (double(y) + 0.5) / double(h));
        for (std::size_t x = 0; x < w; ++x) weights[y * w + x] *= sine;
    }
    table_ = AliasTable(weights);
}

EnvironmentSampler::Seen EnvironmentSampler::look(const Vec3& direction) const {
    if (map_.width == 1 && map_.height == 1) return {map_.pixels[0], 0.0f};
    const float sine = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const Vec2 uv(0.5f + turns_of(direction.x, -direction.z), 2.0f * turns_of(sine, direction.y));
    if (!samplable() || !(sine > 0.0f)) return {radiance(uv), 0.0f};
    const int x = std::clamp(int(uv.x * float(map_.width)), 0, map_.width - 1);
    const int y = std::clamp(int(uv.y * float(map_.height)), 0, map_.height - 1);
    return {radiance(uv), table_.probability(std::uint32_t(y * map_.width + x)) / (texel_at_horizon_ * sine)};
}

Rgb EnvironmentSampler::radiance(const Vec2& uv) const {
    // Counted from a texel further left and up, so that both are positive and truncation is floor().
    const float x = uv.x * float(map_.width) + 0.5f, y = uv.y * float(map_.height) + 0.5f;
    const int right = int(x), below = int(y);
    const float fx = x - float(right), fy = y - float(below);
    const int x0 = right > 0 ? right - 1 : map_.width - 1, x1 = right < map_.width ? right : 0;
    const int y0 = std::max(below - 1, 0), y1 = std::min(below, map_.height - 1);
    return glm::mix(glm::mix(map_.at(x0, y0), map_.at(x1, y0), fx), glm::mix(map_.at(x0, y1), map_.at(x1, y1), fx), fy);
}

EmitterSampler::EmitterSampler(const RayScene& rays, const Materials& materials) : rays_(rays), materials_(materials) {
    const WorldMesh& mesh = rays.mesh();
    std::vector<double> powers, areas;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const Material& material = rays.scene().materials[mesh.materials[t]];
        if (material.unlit || !materials.emits(mesh.materials[t]) || !rays.traced(t)) continue;
        const std::uint32_t* corner = &mesh.indices[3 * std::size_t(t)];
        const Vec3& origin = mesh.positions[corner[0]];
        const bool uniform = material.alpha_mode == AlphaMode::Opaque && material.emission_texture.texture < 0;
        emitters_.push_back({.corner = origin, .edge_u = mesh.positions[corner[1]] - origin,
                             .edge_v = mesh.positions[corner[2]] - origin, .normal = rays.normal(t), .pdf_area = 0.0f,
                             .triangle = t, .lit = material.lit, .uniform = uniform,
                             .radiance = materials.covered_emission(mesh, t, Vec2(1.0f / 3.0f))});
        areas.push_back(triangle_area(mesh, t));
        powers.push_back(areas.back() * mean_emission(rays, materials, t));
    }
    table_ = AliasTable(powers);
    if (table_.empty()) return;
    pdf_area_.resize(mesh.triangle_count(), 0.0f);
    for (std::uint32_t i = 0; i < emitters_.size(); ++i)
        emitters_[i].pdf_area = pdf_area_[emitters_[i].triangle] = float(table_.probability(i) / areas[i]);
}

LightSample EmitterSampler::sample(const Vec3& from, std::uint64_t bits, Vec2 u) const {
    const Emitter& emitter = emitters_[table_.sample(bits).index];
    const Vec2 b = sample_triangle(u.x, u.y);
    LightSample sample;
    const Vec3 way = emitter.corner + emitter.edge_u * b.x + emitter.edge_v * b.y - from;
    sample.distance = glm::length(way);
    if (!(sample.distance > 0.0f)) return sample;
    sample.direction = way / sample.distance;
    const float cosine = -glm::dot(emitter.normal, sample.direction);
    sample.normal = cosine < 0.0f ? -emitter.normal : emitter.normal;
    sample.lit = emitter.lit;
    if (cosine != 0.0f) sample.pdf = emitter.pdf_area * sample.distance * sample.distance / std::abs(cosine);
    if (sample.pdf > 0.0f)
        sample.radiance = emitter.uniform ? emitter.radiance
                                          : materials_.covered_emission(rays_.mesh(), emitter.triangle, b);
    return sample;
}

float EmitterSampler::pdf(std::uint32_t triangle, float distance, float cosine) const {
    if (empty() || cosine == 0.0f) return 0.0f;
    return pdf_area_[triangle] * distance * distance / std::abs(cosine);
}

LampSampler::LampSampler(std::span<const PlacedLight> lamps) {
    for (const PlacedLight& lamp : lamps)
        if (lamp.kind != LightKind::Directional && luminance(lamp.intensity) > 0.0f) lamps_.push_back(lamp);
}

std::optional<LightSample> LampSampler::sample(const Vec3& from, float u) const {
    // One pass of weighted reservoir sampling (Chao 1982) that uses one number up bit by bit.
    const PlacedLight* chosen = nullptr;
    Rgb chosen_irradiance(0.0f);
    float chosen_weight = 0.0f, sum = 0.0f;
    for (const PlacedLight& lamp : lamps_) {
        const Rgb irradiance = facing_irradiance(lamp, lamp.position - from);
        const float weight = luminance(irradiance);
        if (!(weight > 0.0f) || !std::isfinite(weight)) continue;
        sum += weight;
        if (choose(u, weight / sum)) {
            chosen = &lamp;
            chosen_irradiance = irradiance;
            chosen_weight = weight;
        }
    }
    if (!chosen) return std::nullopt;
    const Vec3 way = chosen->position - from;
    const float distance = glm::length(way);
    return LightSample{.direction = way / distance, .distance = distance,
                       .radiance = chosen_irradiance * (sum / chosen_weight)};
}

Lights::Lights(const RayScene& rays, const Materials& materials, const Lighting& lighting,
               std::span<const PlacedLight> lamps_of_scene)
    : sky(lighting.sky),
      emitters(rays, materials),
      lamps(lit_lamps({lamps_of_scene.begin(), lamps_of_scene.end()}, lighting)) {
    for (const Sun& sun : lighting.suns)
        if (luminance(sun.irradiance) > 0.0f) suns.emplace_back(sun);
}

}  // namespace daylit
