#pragma once
// How irradiance changes as a texel's normal leans: what normal maps ask of a lightmap.
#include "gi/surface/smooth.h"
#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/halved_light.h"

namespace daylit {

/// The directions of DayLightmap::tilts at a texel: `u` in which the atlas coordinate u grows on the surface, `v` =
/// normal x u. Unit, world.
struct TiltFrame {
    Vec3 u, v;
};
TiltFrame tilt_frame(const GatherScene& scene, std::size_t texel);

/// Texels of which a normal-mapped material has a part.
std::vector<bool> normal_mapped(const GatherScene& scene);

struct TexelTilts {
    std::vector<std::uint32_t> row_of_texel;  // ~0u: none
    std::vector<std::uint32_t> texel_of_row;
    std::vector<Rgb> rows;  // [row][u, v][component], lux a radian

    std::size_t count() const { return texel_of_row.size(); }
};

/// Rotation gradients of irradiance (Ward and Heckbert 1992) in the frames of the texels:
///     tilt = pi / rays * sum of L * (direction along u or v) / (direction along the normal)
/// of the very rays that were traced for the texels, over all hours. Directions within 6 degrees of the horizon count
/// as if they were there, which bounds the noise.
/// wanted   per texel
TexelTilts texel_tilts(const GatherScene& scene, const GatherHits& hits, const DaySolution& day,
                       const HalvedLight& light, const std::vector<bool>& wanted, const GatherSettings& settings,
                       const StageProgress& progress);

/// Neighbours mixed as their irradiance is (gi/surface/smooth.h), each turned into the other's frame; in place of
/// those without tilts the texel itself.
void smooth_tilts(const GatherScene& scene, const SmoothingWeights& weights, std::size_t components, TexelTilts& tilts);

/// Shares of a ray's light in the two tilts against its share in the irradiance.
inline Vec2 tilt_weights(const TiltFrame& frame, const Vec3& normal, const Vec3& direction) {
    constexpr float kLeastCosine = 0.1f;
    const float cosine = std::max(glm::dot(direction, normal), kLeastCosine);
    return Vec2(glm::dot(direction, frame.u), glm::dot(direction, frame.v)) / cosine;
}

}  // namespace daylit
