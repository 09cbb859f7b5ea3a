#pragma once
// The unbiased reference: unidirectional path tracing with next-event estimation and multiple importance sampling
// (Kajiya 1986; Veach 1997, balance/power heuristic), Russian roulette, counter-based random numbers.
#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/scene/layer.h"
#include "engine/scene/sky.h"
#include "gi/trace/ray_scene.h"

namespace daylit {

struct PathTraceSettings {
    int spp = 64;          // samples per pixel (or per point)
    double error = 0.0;    // > 0: go on until the standard error of the picture's mean, over the mean, is below this
                           // per-pixel RMS measure: rms over pixels of se / mean luminance of the picture; spp is then
                           // the size of one round, max_spp the end
    int max_spp = 1 << 20;
    int max_bounces = 1000;  // segments after the first hit's direct light; roulette ends paths long before
    std::uint64_t seed = 1;
    Layer layer = Layer::Final;  // Final to Depth
};

struct PathTraceImage {
    Image radiance;           // cd/m^2 (or the layer's own unit: lux, albedo, unit vector, metres)
    Image standard_error;     // of each pixel and channel
    int spp = 0;              // spent
    double relative_error = 0.0;  // the measure of PathTraceSettings::error; < 0: unknown, after a single sample
    std::uint64_t rays = 0;       // cast
};

/// A picture. Same inputs and seed, same bytes, for any number of threads (TBB).
PathTraceImage path_trace(const RayScene& rays, const Lighting& lighting, std::span<const PlacedLight> lamps,
                          const View& view, int width, int height, const PathTraceSettings& settings,
                          const Progress& progress = {});

struct SurfaceSample {
    Vec3 position;
    Vec3 normal;  // unit; irradiance arrives on this side
};

/// *Indirect* irradiance in lux at points: sky, emissive surfaces and every bounce, not the straight light of suns and
/// punctual lamps. With settings.layer == Final the straight light is added.
std::vector<Rgb> path_trace_irradiance(const RayScene& rays, const Lighting& lighting,
                                       std::span<const PlacedLight> lamps, std::span<const SurfaceSample> points,
                                       const PathTraceSettings& settings, const Progress& progress = {});

}  // namespace daylit
