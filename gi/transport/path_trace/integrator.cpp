#include "gi/transport/path_trace/integrator.h"

#include <cmath>

#include "gi/transport/path_trace/panes.h"

namespace daylit {
namespace {

// Ends that no path meets by chance: glass may keep light for ever (total reflection), so roulette ends that as well.
constexpr int kGlassEventsBeforeRoulette = 16;
constexpr int kBouncesBeforeRoulette = 3;
constexpr float kSurvivalAtMost = 0.95f;
// Coverage layers and culled faces that a camera ray may cross; more are seen as nothing.
constexpr int kCameraCrossings = 1000;
const float kSunSine = float(std::sin(kSunRadius));

float largest(const Rgb& c) {
    return std::max(c.r, std::max(c.g, c.b));
}

/// What a sample's radiance (a lamp's irradiance) counts for, were nothing between.
inline Rgb weighted_response(const Reflection& reflection, const LightSample& sample) {
    const auto [value, pdf] = reflection.evaluate_with_pdf(sample.direction);
    if (!(sample.pdf > 0.0f)) return value;
    return value * power_heuristic_over_pdf(sample.pdf, pdf);
}

}  // namespace

/// A path under way. `seen`: all so far is what the camera sees straight or refracted, or nothing.
struct Integrator::Path {
    Wave* wave = nullptr;
    PathRandom* random = nullptr;
    Rgb direct = Rgb(0.0f), indirect = Rgb(0.0f);
    Rgb throughput = Rgb(1.0f);
    float roulette_scale = 1.0f;  // of throughput at the start
    bool seen = true;             // no mirror image in glass between the eye and the first surface
    bool specular = true;         // the last event was the eye or glass: no light sampling competes
    int segments = 0;             // since the first surface; glass does not count
    int glass_events = 0;
    float pdf = 0.0f;             // of the last direction, when not specular
    std::uint64_t sky_bits = 0;   // what plan_sky() drew
    std::uint32_t rays = 0;

    /// Light straight from the eye's first surface, or from the sun to it, is direct; what else there is, indirect.
    void add(const Rgb& light, bool straight) { (straight ? direct : indirect) += throughput * light; }
};

/// What a shadow ray brings its path, were nothing between; times the sky's radiance where it leads into the sky.
struct Integrator::Shadow {
    Rgb light;
    bool straight = false;
    std::optional<Vec2> sky = std::nullopt;
};

/// Shadow rays towards lights of one kind that wait to be traced together.
struct Integrator::Shadows {
    std::size_t count = 0;
    std::array<Ray, kWave> rays;
    std::array<Shadow, kWave> shadows;
    std::array<Path*, kWave> paths;
};

/// Paths that start close together. The shadow rays of their first surfaces are close to each other as well: traced as
/// bundles they cost less, and no path waits for what they find.
struct Integrator::Wave {
    std::array<Path, kWave> paths;
    Shadows suns, lamps, sky, emitters;
};

Integrator::Integrator(const RayScene& rays, const Lighting& lighting, std::span<const PlacedLight> lamps,
                       const PathTraceSettings& settings)
    : rays_(rays),
      settings_(settings),
      materials_(rays.scene(), lighting.scales.evening),
      lights_(rays, materials_, lighting, lamps),
      panes_(find_panes(rays.mesh(), materials_)),
      want_direct_(settings.layer != Layer::Indirect), want_indirect_(settings.layer != Layer::Direct) {}

void Integrator::camera_samples(std::span<CameraStart> starts, std::span<Sample> samples) const {
    Wave wave;
    std::array<Ray, kWave> rays;
    std::array<std::uint64_t, kWave> keys;
    std::array<std::optional<Hit>, kWave> hits;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        Path& path = wave.paths[i];
        path.wave = &wave;
        path.random = &starts[i].random;
        plan_sky(path);
        rays[i] = {starts[i].ray.origin, starts[i].ray.direction};
        keys[i] = path.random->bits();
        ++path.rays;
    }
    rays_.closest(std::span(rays).first(starts.size()), keys, hits);
    for (std::size_t i = 0; i < starts.size(); ++i) follow(wave.paths[i], rays[i], hits[i]);
    finish(wave, samples);
}

void Integrator::irradiance_samples(const SurfaceSample& point, std::span<PathRandom> randoms,
                                    std::span<Sample> samples) const {
    Wave wave;
    for (std::size_t i = 0; i < randoms.size(); ++i) {
        Path& path = wave.paths[i];
        path.wave = &wave;
        path.random = &randoms[i];
        plan_sky(path);
        irradiate(path, point.position, point.normal, point.normal);
    }
    finish(wave, samples);
}

/// Follows a camera's path whose first ray found `hit`, for whatever the layer asks.
void Integrator::follow(Path& path, const Ray& camera_ray, const std::optional<Hit>& hit) const {
    const std::optional<FoundSurface> found = first_surface(path, camera_ray, hit);
    const bool picture = settings_.layer <= Layer::Indirect;
    if (!found) {
        if (picture) add_background(path, camera_ray.direction);
    } else if (picture) {
        Ray onward = found->ray;
        if (meet(path, onward, found->hit)) trace(path, onward);
    } else if (settings_.layer == Layer::Depth) {
        path.add(Rgb(found->travelled + found->hit.distance), true);
    } else {
        const SurfacePoint point = rays_.surface_point(found->ray, found->hit);
        if (settings_.layer == Layer::Irradiance)
            irradiate(path, point.position, point.geometric_normal, point.shading_normal);
        else
            path.add(surface_layer(point), true);
    }
}

/// Gathers the irradiance at a surface, as the light that a white one of albedo pi reflects.
void Integrator::irradiate(Path& path, const Vec3& position, const Vec3& geometric_normal,
                           const Vec3& shading_normal) const {
    path.roulette_scale = kPiF;
    Ray onward;
    if (scatter(path, onward, position, geometric_normal, Reflection::irradiance(geometric_normal, shading_normal)))
        trace(path, onward);
}

/// Traces the shadow rays that still wait and sums up.
void Integrator::finish(Wave& wave, std::span<Sample> samples) const {
    for (Shadows* shadows : {&wave.suns, &wave.lamps, &wave.sky, &wave.emitters}) trace_shadows(*shadows);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Path& path = wave.paths[i];
        samples[i].value = Rgb(0.0f);
        if (want_direct_) samples[i].value += path.direct;
        if (want_indirect_) samples[i].value += path.indirect;
        samples[i].rays = path.rays;
    }
}

/// The surface that the camera sees: faces that it would see from behind are passed unless they are double-sided.
/// hit   of the camera ray
std::optional<Integrator::FoundSurface> Integrator::first_surface(Path& path, const Ray& camera_ray,
                                                                  std::optional<Hit> hit) const {
    FoundSurface found{.hit = {}, .ray = camera_ray};
    for (int crossing = 1; hit; ++crossing) {
        found.hit = *hit;
        const Material& material = rays_.scene().materials[rays_.mesh().materials[hit->triangle]];
        if (material.double_sided || glm::dot(found.ray.direction, hit->normal) <= 0.0f) return found;
        if (crossing == kCameraCrossings) break;
        const Vec3 position = found.ray.origin + found.ray.direction * hit->distance;
        found.ray.origin = RayScene::offset_origin(position, hit->normal, found.ray.direction);
        found.travelled += hit->distance;
        ++path.rays;
        hit = rays_.closest(found.ray, path.random->bits());
    }
    return std::nullopt;
}

Rgb Integrator::surface_layer(const SurfacePoint& point) const {
    if (settings_.layer == Layer::Normal) return point.shading_normal * 0.5f + 0.5f;
    const glsl::Brdf brdf = materials_.brdf(point);
    return brdf.diffuse + brdf.specular;
}

/// Follows the path to its end.
void Integrator::trace(Path& path, Ray& ray) const {
    for (;;) {
        ++path.rays;
        const std::optional<Hit> hit = rays_.closest(ray, path.random->bits());
        if (!hit) return add_background(path, ray.direction);
        if (!meet(path, ray, *hit)) return;
    }
}

/// Light from and at the surface that `ray` hits, and the next ray. False: the path ends here.
bool Integrator::meet(Path& path, Ray& ray, const Hit& hit) const {
    const SurfacePoint point = rays_.surface_point(ray, hit);
    if (materials_.emits(point.material)) add_emission(path, ray, hit, point);
    if (materials_.meets_glass(point, *path.random)) {
        pass_glass(path, ray, hit, point);
        if (!want_indirect_ && !path.seen) return false;
        return path.glass_events <= kGlassEventsBeforeRoulette || survives(path);
    }
    if (materials_.unlit(point.material)) return false;
    if (path.segments > 0 && path.segments >= settings_.max_bounces) return false;

    const Reflection reflection(materials_.brdf(point), point.geometric_normal, point.shading_normal, -ray.direction);
    if (!scatter(path, ray, point.position, point.geometric_normal, reflection)) return false;
    return path.segments <= kBouncesBeforeRoulette || survives(path);
}

/// Where in the sky the next surface will look, drawn one ray ahead: by then its part of the table has arrived from
/// memory.
void Integrator::plan_sky(Path& path) const {
    if (!want_indirect_ || !lights_.sky.samplable()) return;
    path.sky_bits = path.random->bits();
    lights_.sky.prefetch(path.sky_bits);
}

/// What a ray finds that leaves the scene: the sky, and a sun's disc.
void Integrator::add_background(Path& path, const Vec3& direction) const {
    const bool eye = path.segments == 0 && path.seen;
    if (!lights_.sky.black()) {
        const EnvironmentSampler::Seen seen = lights_.sky.look(direction);
        path.add(seen.radiance * (path.specular ? 1.0f : power_heuristic(path.pdf, seen.pdf)), eye);
    }
    for (const SunDisc& sun : lights_.suns) {
        if (!sun.contains(direction)) continue;
        const float weight = path.specular ? 1.0f : power_heuristic(path.pdf, sun.pdf());
        // Sunlight straight on the first surface, found by the surface's own sampling, is direct as well.
        path.add(sun.radiance() * weight, eye || (path.segments == 1 && path.seen && !path.specular));
    }
}

void Integrator::add_emission(Path& path, const Ray& ray, const Hit& hit, const SurfacePoint& point) const {
    const Rgb radiance = materials_.emission(point);
    float weight = 1.0f;
    if (!path.specular)
        weight = power_heuristic(
            path.pdf, lights_.emitters.pdf(hit.triangle, hit.distance, glm::dot(hit.normal, ray.direction)));
    path.add(radiance * weight, path.segments == 0 && path.seen);
}

void Integrator::pass_glass(Path& path, Ray& ray, const Hit& hit, const SurfacePoint& point) const {
    const Material& material = rays_.scene().materials[point.material];
    const bool pane = panes_[hit.triangle];
    const bool entering = glm::dot(ray.direction, hit.normal) < 0.0f;
    // A bumped normal that the ray meets from behind would turn reflection into the body.
    const Vec3 normal =
        glm::dot(point.shading_normal, ray.direction) < 0.0f ? point.shading_normal : point.geometric_normal;
    const float eta = entering ? material.ior : 1.0f / material.ior;
    const float u = path.random->next();
    GlassBounce bounce = pane ? sample_pane(ray.direction, normal, material.ior, u)
                              : sample_glass(ray.direction, normal, eta, u);
    if ((glm::dot(bounce.direction, point.geometric_normal) < 0.0f) != bounce.transmitted)
        bounce.direction -= 2.0f * glm::dot(bounce.direction, point.geometric_normal) * point.geometric_normal;
    if (bounce.transmitted) {
        // A body has two boundaries, each with half of the tint's density.
        const Rgb tint = materials_.color(point);
        path.throughput *= pane ? tint : glm::sqrt(tint);
    } else if (path.segments == 0) {
        path.seen = false;
    }
    ++path.glass_events;
    path.specular = true;
    ray.origin = RayScene::offset_origin(point.position, point.geometric_normal, bounce.direction);
    ray.direction = bounce.direction;
}

/// Adds the light that arrives at a surface by light sampling, and draws the next ray. False: the path ends here.
bool Integrator::scatter(Path& path, Ray& ray, const Vec3& position, const Vec3& geometric_normal,
                         const Reflection& reflection) const {
    const bool first = path.segments == 0;
    const bool ends = path.segments >= settings_.max_bounces;  // only at the first surface, with no bounce at all
    if (first ? (path.seen ? want_direct_ : want_indirect_) : want_indirect_)
        add_straight_light(path, position, geometric_normal, reflection);
    if (want_indirect_ && !ends) add_area_light(path, position, geometric_normal, reflection);

    const Reflection::Sample next = reflection.sample(first ? path.random->pair(Net::Bounce) : path.random->pair());
    if (next.pdf == 0.0f) return false;
    // The next ray of direct light, or of a path that ends here, can only bring the sun.
    const bool only_sun = !want_indirect_ || ends;
    if (only_sun && !sun_in(next.direction)) return false;
    path.throughput *= next.weight;
    path.pdf = next.pdf;
    path.specular = false;
    ++path.segments;
    ray.origin = RayScene::offset_origin(position, geometric_normal, next.direction);
    ray.direction = next.direction;
    if (!only_sun) {
        plan_sky(path);
        return true;
    }
    ++path.rays;
    const float through = rays_.transmittance(ray);
    if (through > 0.0f) {
        for (const SunDisc& sun : lights_.suns)
            if (sun.contains(ray.direction))
                path.add(sun.radiance() * (through * power_heuristic(path.pdf, sun.pdf())), first && path.seen);
    }
    return false;
}

/// Suns and lamps, one shadow ray a sun and one for all lamps.
void Integrator::add_straight_light(Path& path, const Vec3& position, const Vec3& geometric_normal,
                                    const Reflection& reflection) const {
    const bool first = path.segments == 0, direct = first && path.seen;
    const auto add = [&](Shadows& shadows, const LightSample& sample) {
        const Rgb response = weighted_response(reflection, sample);
        if (response != Rgb(0.0f))
            cast_shadow(path, shadows, position, geometric_normal, sample,
                        {.light = path.throughput * response * sample.radiance, .straight = direct});
    };
    for (const SunDisc& sun : lights_.suns) {
        if (!reflection.may_receive(sun.direction(), kSunSine)) continue;
        add(path.wave->suns,
            sun.sample(first && &sun == lights_.suns.data() ? path.random->pair(Net::Sun) : path.random->pair()));
    }
    if (lights_.lamps.empty()) return;
    const float u = first ? path.random->pair(Net::Lamp).x : path.random->next();
    if (const std::optional<LightSample> sample = lights_.lamps.sample(position, u)) add(path.wave->lamps, *sample);
}

/// Sky and emissive surfaces, one shadow ray each.
void Integrator::add_area_light(Path& path, const Vec3& position, const Vec3& geometric_normal,
                                const Reflection& reflection) const {
    if (lights_.sky.samplable()) {
        const EnvironmentSampler::Draw draw = lights_.sky.sample(path.sky_bits, path.random->pair());
        const Rgb response = weighted_response(reflection, draw.light);
        if (response != Rgb(0.0f))
            cast_shadow(path, path.wave->sky, position, geometric_normal, draw.light,
                        {.light = path.throughput * response, .sky = draw.uv});
    }
    if (!lights_.emitters.empty()) {
        const Vec2 u = path.segments == 0 ? path.random->pair(Net::Emitter) : path.random->pair();
        const LightSample sample = lights_.emitters.sample(position, path.random->bits(), u);
        if (sample.radiance == Rgb(0.0f)) return;
        const Rgb response = weighted_response(reflection, sample);
        if (response != Rgb(0.0f))
            cast_shadow(path, path.wave->emitters, position, geometric_normal, sample,
                        {.light = path.throughput * response * sample.radiance});
    }
}

/// Adds the light of a sample as far as nothing is between: now, or when its wave's shadow rays are traced.
void Integrator::cast_shadow(Path& path, Shadows& shadows, const Vec3& position, const Vec3& geometric_normal,
                             const LightSample& sample, const Shadow& shadow) const {
    Ray ray{RayScene::offset_origin(position, geometric_normal, sample.direction), sample.direction};
    if (sample.distance < 1e30f) {
        // Both ends stand off their surfaces and the ray is aimed anew from one to the other: neither end shadows
        // itself, however flat the ray.
        const Vec3 end = position + sample.direction * sample.distance;
        const Vec3 target =
            sample.normal == Vec3(0.0f) ? end : RayScene::offset_origin(end, sample.normal, -sample.direction);
        const Vec3 way = target - ray.origin;
        ray.t_max = glm::length(way);
        if (!(ray.t_max > 0.0f)) return add_unshadowed(path, shadow, 1.0f);
        ray.direction = way / ray.t_max;
    }
    ++path.rays;
    if (path.segments > 0) return add_unshadowed(path, shadow, rays_.transmittance(ray));
    shadows.rays[shadows.count] = ray;
    shadows.shadows[shadows.count] = shadow;
    shadows.paths[shadows.count] = &path;
    if (++shadows.count == kWave) trace_shadows(shadows);
}

void Integrator::trace_shadows(Shadows& shadows) const {
    if (shadows.count == 0) return;
    std::array<float, kWave> through;
    rays_.transmittance(std::span(shadows.rays).first(shadows.count), through);
    for (std::size_t i = 0; i < shadows.count; ++i) add_unshadowed(*shadows.paths[i], shadows.shadows[i], through[i]);
    shadows.count = 0;
}

/// through   share of the light that arrives
void Integrator::add_unshadowed(Path& path, const Shadow& shadow, float through) const {
    if (!(through > 0.0f)) return;
    const Rgb light = shadow.light * through;
    (shadow.straight ? path.direct : path.indirect) += shadow.sky ? light * lights_.sky.radiance(*shadow.sky) : light;
}

bool Integrator::sun_in(const Vec3& direction) const {
    for (const SunDisc& sun : lights_.suns)
        if (sun.contains(direction)) return true;
    return false;
}

/// Russian roulette by what the path can still bring.
bool Integrator::survives(Path& path) const {
    const float chance = std::min(largest(path.throughput) / path.roulette_scale, kSurvivalAtMost);
    if (!(path.random->next() < chance)) return false;
    path.throughput /= chance;
    return true;
}

}  // namespace daylit
