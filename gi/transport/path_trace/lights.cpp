#include "gi/transport/path_trace/lights.h"

#include <cmath>

namespace daylit {
namespace {

// 1 - cos(kSunRadius), by the half angle so that nothing cancels.
const double kSunCapHeight = 2.0 * std::pow(std::sin(0.5 * kSunRadius), 2.0);

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
    : frame_(sun.direction), radiance_(disc_radiance(sun)), pdf_(pdf_cap(float(kSunCapHeight))) {}

LightSample SunDisc::sample(float u, float v) const {
    return {.direction = frame_.to_world(sample_cap(float(kSunCapHeight), u, v)), .radiance = radiance_, .pdf = pdf_};
}

bool SunDisc::contains(const Vec3& direction) const {
    // By the chord, |d - s|^2 = 2 (1 - cos): the dot product of two floats would blur the disc's rim.
    const Vec3 chord = direction - frame_.z;
    return glm::dot(chord, chord) <= 2.0f * float(kSunCapHeight);
}

EnvironmentSampler::EnvironmentSampler(const Environment& sky)
    : map_(sky.map), black_(sky.map.empty() || sky.black()) {
    if (black_ || sky.constant()) return;
    const auto w = std::size_t(map_.width), h = std::size_t(map_.height);
    std::vector<double> weights = bilinear_texel_means(map_);
    row_edge_cos_.push_back(1.0f);
    for (std::size_t y = 0; y < h; ++y) {
        const double top = std::cos(kPi * double(y) / double(h)), bottom = std::cos(kPi * double(y + 1) / double(h));
        const double solid_angle = 2.0 * kPi / double(w) * (top - bottom);
        row_edge_cos_.push_back(float(bottom));
        row_solid_angle_.push_back(float(solid_angle));
        for (std::size_t x = 0; x < w; ++x) weights[y * w + x] *= solid_angle;
    }
    table_ = AliasTable(weights);
}

EnvironmentSampler::Draw EnvironmentSampler::sample(Random& random) const {
    const auto [cell, chance] = table_.sample(random.bits());
    const std::uint32_t w = std::uint32_t(map_.width), x = cell % w, y = cell / w;
    const float cos_polar = glm::mix(row_edge_cos_[y], row_edge_cos_[y + 1], random.next());
    const float sin_polar = std::sqrt(std::max(1.0f - cos_polar * cos_polar, 0.0f));
    const float u = (float(x) + random.next()) / float(w);
    const float bearing = (u - 0.5f) * 2.0f * kPiF;
    Draw draw;
    draw.light.direction = Vec3(sin_polar * std::sin(bearing), cos_polar, -sin_polar * std::cos(bearing));
    draw.light.pdf = chance / row_solid_angle_[y];
    draw.uv = Vec2(u, std::acos(cos_polar) / kPiF);
    return draw;
}

EnvironmentSampler::Seen EnvironmentSampler::look(const Vec3& direction) const {
    if (map_.width == 1 && map_.height == 1) return {map_.pixels[0], 0.0f};
    const Vec2 uv(0.5f + std::atan2(direction.x, -direction.z) / (2.0f * kPiF),
                  std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / kPiF);
    if (!samplable()) return {radiance(uv), 0.0f};
    const int x = std::clamp(int(uv.x * float(map_.width)), 0, map_.width - 1);
    const int y = std::clamp(int(uv.y * float(map_.height)), 0, map_.height - 1);
    return {radiance(uv), table_.probability(std::uint32_t(y * map_.width + x)) / row_solid_angle_[std::size_t(y)]};
}

Rgb EnvironmentSampler::radiance(const Vec2& uv) const {
    const float x = uv.x * float(map_.width) - 0.5f, y = uv.y * float(map_.height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    int x0 = int(left), x1 = x0 + 1;
    if (x0 < 0) x0 += map_.width;
    if (x1 >= map_.width) x1 -= map_.width;
    const int y0 = std::max(int(top), 0), y1 = std::min(int(top) + 1, map_.height - 1);
    return glm::mix(glm::mix(map_.at(x0, y0), map_.at(x1, y0), x - left),
                    glm::mix(map_.at(x0, y1), map_.at(x1, y1), x - left), y - top);
}

EmitterSampler::EmitterSampler(const RayScene& rays, const Materials& materials) : rays_(rays), materials_(materials) {
    const WorldMesh& mesh = rays.mesh();
    std::vector<double> powers, areas;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const Material& material = rays.scene().materials[mesh.materials[t]];
        if (material.unlit || !materials.emits(mesh.materials[t]) || !rays.traced(t)) continue;
        triangles_.push_back(t);
        areas.push_back(triangle_area(mesh, t));
        powers.push_back(areas.back() * mean_emission(rays, materials, t));
    }
    table_ = AliasTable(powers);
    if (table_.empty()) return;
    pdf_area_.resize(mesh.triangle_count(), 0.0f);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        pdf_area_[triangles_[i]] = float(table_.probability(i) / areas[i]);
}

LightSample EmitterSampler::sample(const Vec3& from, Random& random) const {
    const std::uint32_t triangle = triangles_[table_.sample(random.bits()).index];
    const float u = random.next(), v = random.next();
    const Vec2 b = sample_triangle(u, v);
    const WorldMesh& mesh = rays_.mesh();
    const std::uint32_t* corner = &mesh.indices[3 * std::size_t(triangle)];
    const Vec3 point = mesh.positions[corner[0]] * (1.0f - b.x - b.y) + mesh.positions[corner[1]] * b.x +
                       mesh.positions[corner[2]] * b.y;
    LightSample sample;
    const Vec3 way = point - from;
    sample.distance = glm::length(way);
    if (!(sample.distance > 0.0f)) return sample;
    sample.direction = way / sample.distance;
    const Vec3 normal = rays_.normal(triangle);
    const float cosine = -glm::dot(normal, sample.direction);
    sample.normal = cosine < 0.0f ? -normal : normal;
    sample.lit = rays_.scene().materials[mesh.materials[triangle]].lit;
    sample.pdf = pdf(triangle, sample.distance, cosine);
    if (sample.pdf > 0.0f) sample.radiance = materials_.covered_emission(mesh, triangle, b);
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

std::optional<LightSample> LampSampler::sample(const Vec3& from, Random& random) const {
    // One pass of weighted reservoir sampling (Chao 1982).
    const PlacedLight* chosen = nullptr;
    Rgb chosen_irradiance(0.0f);
    float chosen_weight = 0.0f, sum = 0.0f;
    for (const PlacedLight& lamp : lamps_) {
        const Rgb irradiance = facing_irradiance(lamp, lamp.position - from);
        const float weight = luminance(irradiance);
        if (!(weight > 0.0f) || !std::isfinite(weight)) continue;
        sum += weight;
        if (lamps_.size() == 1 || random.next() * sum < weight) {
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
