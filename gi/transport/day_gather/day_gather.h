#pragma once
// Light at texels over the day. A ray's hit does not depend on the hour: each receiver's rays are traced once, and the
// hits, which make one big sparse matrix, are applied to all hours as columns; bounces are repeated application.
// day_columns.h says what the columns are, day_solution.h how the result is kept.
//
// In this form gloss reflects like Lambert with its whole albedo; a texel reflects with its mean albedo, under a normal
// map as much less as its normals lean.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gi/checkpoint.h"
#include "gi/parallel.h"
#include "gi/surface/texels.h"
#include "gi/trace/ray_scene.h"
#include "gi/transport/day_gather/day_solution.h"

namespace daylit {

/// Where light is gathered: one side of a texel. Faces are two-sided for light, so the back of a texel that some ray
/// meets is a receiver of its own; the lightmap keeps the fronts.
struct Receiver {
    std::uint32_t texel = 0;
    bool back = false;
};

/// Light of what shines always and of what shines in the evening only, at its full strength.
struct ByLit {
    Rgb always = Rgb(0.0f), evening = Rgb(0.0f);
    Rgb& of(Lit lit) { return lit == Lit::Evening ? evening : always; }
    void operator+=(const ByLit& other) { always += other.always, evening += other.evening; }
    void operator*=(float factor) { always *= factor, evening *= factor; }
};

inline constexpr std::uint32_t kSkyBit = 1u << 31, kNoLight = ~0u;

struct GatherHits {
    int rays = 0;                     // per receiver
    std::vector<Receiver> receivers;  // the front of every texel in order, then backs
    std::vector<std::uint32_t> hit;   // receivers * rays: a receiver, or kSkyBit | sky bin, or kNoLight
    std::vector<float> scale;         // per receiver: 1 / rays that count; 0: the receiver is inside solid geometry
    std::vector<std::uint16_t>
        usable;                   // per receiver: bit k set when point k of its texel is not inside solid geometry
    std::vector<float> nearness;  // per receiver: harmonic mean distance of what it sees, metres
    std::vector<ByLit> emission;  // per receiver: lux straight from emissive surfaces
    std::vector<std::array<ByLit, 2>>
        emission_tilts;  // per receiver: how it changes as the normal leans (texel_tilts.h)
    bool buried(std::size_t receiver) const { return scale[receiver] == 0.0f; }
    /// Where what a ray met is among receivers and, after them, sky bins. Not for kNoLight.
    std::size_t source(std::uint32_t hit) const { return hit & kSkyBit ? receivers.size() + (hit & ~kSkyBit) : hit; }
};

struct GatherSettings {
    int rays = 96;     // per receiver
    int bounces = 64;  // at most; ends earlier when the rest is below `rest` of all light
    double rest = 0.003;
    std::uint64_t seed = 1;
};

/// Mean albedo (shaders/shared/brdf.h) and place of everything the stages share.
struct GatherScene {
    const RayScene& rays;
    const Atlas& atlas;
    const Texels& texels;
    std::span<const PlacedLight> lamps;  // point and spot
    std::vector<Rgb> albedo;             // per texel
    std::vector<float> evenness;         // per texel: mean cosine of its normal map's normals (mean_cosine())
};
GatherScene gather_scene(const RayScene& rays, const Atlas& atlas, const Texels& texels,
                         std::span<const PlacedLight> lamps);

/// checkpoint   finished receivers are kept there, and those that it holds are not traced again
GatherHits trace_hits(const GatherScene& scene, const GatherSettings& settings, Checkpoint& checkpoint,
                      const StageProgress& progress);

/// Straight light of the punctual lamps on every receiver, lux.
std::vector<ByLit> lamp_irradiance(const GatherScene& scene, const GatherHits& hits, const GatherSettings& settings,
                                   const StageProgress& progress);

/// Straight light of suns that stand still on every receiver, lux.
std::vector<Rgb> sun_irradiance(const GatherScene& scene, const GatherHits& hits, std::span<const Sun> suns,
                                const GatherSettings& settings, const StageProgress& progress);

/// The whole day's light at receivers.
/// lamp_irradiance   straight light of punctual lamps on every receiver, lux
DaySolution solve_day(const GatherScene& scene, const GatherHits& hits, std::span<const ByLit> lamp_irradiance,
                      const DayLight& light, const GatherSettings& settings, const StageProgress& progress);

}  // namespace daylit
