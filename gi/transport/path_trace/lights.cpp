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

EnvironmentSampler::EnvironmentSampler(const Environment& sky) : sky_(sky), black_(sky.black()) {
    if (black_ || sky.constant()) return;
    const auto w = std::size_t(sky.map.width), h = std::size_t(sky.map.height);
    cell_solid_angle_.resize(h);
    std::vector<double> weights = bilinear_texel_means(sky.map);
    for (std::size_t y = 0; y < h; ++y) {
        const double top = std::cos(kPi * double(y) / double(h)), bottom = std::cos(kPi * double(y + 1) / double(h));
        const double solid_angle = 2.0 * kPi / double(w) * (top - bottom);
        cell_solid_angle_[y] = float(solid_angle);
        for (std::size_t x = 0; x < w; ++x) weights[y * w + x] *= solid_angle;
    }
    table_ = AliasTable(weights);
}

LightSample EnvironmentSampler::sample(Random& random) const {
    const int w = sky_.map.width, h = sky_.map.height;
    const std::uint32_t cell = table_.sample(random.next_double());
    const int x = int(cell) % w, y = int(cell) / w;
    const double top = std::cos(kPi * double(y) / h), bottom = std::cos(kPi * double(y + 1) / h);
    const double cos_polar = top + (bottom - top) * random.next_double();
    const double u = (x + random.next_double()) / w;
    LightSample sample;
    sample.direction = direction_from_latlong(Vec2(u, std::acos(cos_polar) / kPi));
    sample.radiance = sky_.radiance(sample.direction);
    sample.pdf = table_.probability(cell) / cell_solid_angle_[std::size_t(y)];
    return sample;
}

float EnvironmentSampler::pdf(const Vec3& direction) const {
    if (!samplable()) return 0.0f;
    const int w = sky_.map.width, h = sky_.map.height;
    const Vec2 uv = latlong_from_direction(direction);
    const int x = std::clamp(int(uv.x * float(w)), 0, w - 1), y = std::clamp(int(uv.y * float(h)), 0, h - 1);
    return table_.probability(std::uint32_t(y * w + x)) / cell_solid_angle_[std::size_t(y)];
}

EmitterSampler::EmitterSampler(const RayScene& rays, const Materials& materials) : rays_(rays), materials_(materials) {
    const WorldMesh& mesh = rays.mesh();
    std::vector<double> powers, areas;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const Material& material = rays.scene().materials[mesh.materials[t]];
        if (material.unlit || luminance(material.emission) <= 0.0f || !rays.traced(t)) continue;
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
    const std::uint32_t triangle = triangles_[table_.sample(random.next_double())];
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
    : sky(lighting.sky), emitters(rays, materials), lamps(lamps_of_scene) {
    for (const Sun& sun : lighting.suns)
        if (luminance(sun.irradiance) > 0.0f) suns.emplace_back(sun);
}

}  // namespace daylit
