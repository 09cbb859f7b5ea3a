#pragma once
// Light at texels over the day. A ray's hit does not depend on the hour: each receiver's rays are traced once, and the
// hits, which make one big sparse matrix, are applied to all hours as columns; bounces are repeated application.
//
// In this first form gloss reflects like Lambert with its whole albedo, and a texel reflects with its mean albedo.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/sky.h"
#include "gi/parallel.h"
#include "gi/surface/texels.h"
#include "gi/trace/ray_scene.h"

namespace daylit {

/// Where light is gathered: one side of a texel. Faces are two-sided for light, so the back of a texel that some ray
/// meets is a receiver of its own; the lightmap keeps the fronts.
struct Receiver {
    std::uint32_t texel = 0;
    bool back = false;
};

struct GatherHits {
    int rays = 0;                          // per receiver
    std::vector<Receiver> receivers;       // the front of every texel in order, then backs
    std::vector<std::uint32_t> hit;        // receivers * rays: a receiver, or kSkyBit | sky bin, or kNoLight
    std::vector<float> scale;              // per receiver: 1 / rays that count; 0: the receiver is inside solid geometry
    std::vector<std::uint16_t> usable;     // per receiver: bit k set when point k of its texel is not inside solid geometry
    std::vector<float> nearness;           // per receiver: harmonic mean distance of what it sees, metres
    std::vector<Rgb> emission;             // per receiver: lux straight from emissive surfaces
    bool buried(std::size_t receiver) const { return scale[receiver] == 0.0f; }
};
inline constexpr std::uint32_t kSkyBit = 1u << 31, kNoLight = ~0u;

struct GatherSettings {
    int rays = 96;        // per receiver
    int bounces = 64;     // at most; ends earlier when the rest is below `rest` of all light
    double rest = 0.003;
    std::uint64_t seed = 1;
};

/// Albedo (diffuse + specular) and place of everything the stages share.
struct GatherScene {
    const RayScene& rays;
    const Atlas& atlas;
    const Texels& texels;
    std::span<const PlacedLight> lamps;  // point and spot
    std::vector<Rgb> albedo;             // per texel
};
GatherScene gather_scene(const RayScene& rays, const Atlas& atlas, const Texels& texels,
                         std::span<const PlacedLight> lamps);

/// Rays of probes in free space, over the whole sphere.
struct ProbeHits {
    int rays = 0;                          // per probe
    std::vector<Vec3> position;            // of each probe
    std::vector<std::uint32_t> hit;        // probes * rays, as GatherHits::hit
    std::vector<Vec3> direction;           // of each ray as it leaves the probe
    std::vector<bool> buried;              // per probe: inside solid geometry
    std::vector<std::array<Rgb, 9>> emission;  // per probe: SH of radiance straight from emissive surfaces
    std::size_t count() const { return position.size(); }
};

GatherHits trace_hits(const GatherScene& scene, const GatherSettings& settings, const StageProgress& progress);

/// The same question asked in free space: what they meet are the receivers of `hits`.
/// rays   per probe
ProbeHits trace_probes(const GatherScene& scene, const GatherHits& hits, std::span<const Vec3> positions, int rays,
                       const GatherSettings& settings, const StageProgress& progress);

/// Straight light of punctual lamps on every receiver, lux.
std::vector<Rgb> lamp_irradiance(const GatherScene& scene, const GatherHits& hits, const GatherSettings& settings,
                                 const StageProgress& progress);

/// Straight light of the suns on one receiver at each hour: added to out[hour], lux.
void add_sun_irradiance(const GatherScene& scene, const GatherHits& hits, std::span<const Lighting> hours,
                        const GatherSettings& settings, std::size_t receiver, Rgb* out);

/// Mean radiance of the sky's bins, cd/m^2.
std::vector<Rgb> sky_bins(const Environment& sky);
std::uint32_t sky_bin(const Vec3& direction);

/// *Indirect* irradiance, lux: rows are texels, columns the hours and, last, what does not change (lamps, emission).
struct DayIrradiance {
    std::size_t columns = 0;
    std::vector<Rgb> rows;          // texels * columns
    std::vector<double> mean_total;  // per column: mean luminance of all reflected light, albedo * E (direct included)
    int bounces = 0;                // that it took
    Rgb* row(std::size_t texel) { return rows.data() + texel * columns; }
    const Rgb* row(std::size_t texel) const { return rows.data() + texel * columns; }
};
/// SH of *indirect* radiance, cd/m^2: [probe][column][coefficient], columns as in DayIrradiance.
struct DayRadiance {
    std::size_t columns = 0;
    std::vector<std::array<Rgb, 9>> sh;  // probes * columns
    std::array<Rgb, 9>* row(std::size_t probe) { return sh.data() + probe * columns; }
    const std::array<Rgb, 9>* row(std::size_t probe) const { return sh.data() + probe * columns; }
};

struct DaySolution {
    DayIrradiance texels;
    DayRadiance probes;
};
DaySolution solve_day(const GatherScene& scene, const GatherHits& hits, const ProbeHits& probes,
                      std::span<const Rgb> lamp_irradiance, std::span<const Lighting> hours,
                      const GatherSettings& settings, const StageProgress& progress);

}  // namespace daylit
