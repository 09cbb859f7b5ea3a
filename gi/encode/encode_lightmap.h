#pragma once
// The light of texels over the day as the lightmap that the runtime reads.
#include "engine/baked/day_lightmap.h"
#include "gi/encode/light_rows.h"
#include "gi/surface/texels.h"

namespace daylit {

/// How the light of rows changes as their normals lean (DayLightmap::tilts), in the same components.
struct TiltRows {
    std::span<const std::uint32_t> of_row;  // per row of light: its row here, or ~0u
    std::span<const Rgb> rows;              // [row][u, v][component]
};

struct LightmapSettings {
    int most_patterns = DayLightmap::kMostPatterns;  // of a tile
    int usual_patterns = 24;                         // of a tile whose error is below `bad_error` with these
    double error = 0.01;      // of a tile's worst moment, relative: where no further pattern is added
    double bad_error = 0.03;  // the same, where it shows as a tint
    double step = 0.004;      // of texels, relative, at the moment when a pattern shines most
    BasisSettings basis;
};

struct EncodedLightmap {
    DayLightmap map;
    double error = 0.0;          // worst moment's, root mean square over texels; see measure_error
    double worst_tile = 0.0;     // the largest of a tile at a moment
    double mean_patterns = 0.0;  // of a texel's tile
    double keyframes_error = 0.0;
};

/// rows     of the texels that hold light
/// tilts    by row of `rows`; empty where no texel has any
/// row_of_pixel   per texel of the atlas (map.width * map.height): its row, or ~0u in gaps between charts
/// map      width, height and corner_uvs are kept, the rest filled in
/// A tile with tilts shares its patterns between texels and tilts.
/// Errors are relative to light as an eye would see it that is adapted to the tile: texels against their own brightness
/// over the day, moments against the tile's brightness at that moment; measured on the bytes that are written, at every
/// moment, the keyframes' error included.
EncodedLightmap encode_lightmap(DayLightmap map, const LightRows& rows, const TiltRows& tilts,
                                std::span<const std::uint32_t> row_of_pixel, const LightmapSettings& settings);

/// For every texel of the atlas its row; the rest of each chart's grid takes the nearest that has one.
/// row_of_texel   ~0u for texels without light (inside solid geometry)
std::vector<std::uint32_t> rows_of_pixels(const Atlas& atlas, const Texels& texels,
                                          std::span<const std::uint32_t> row_of_texel);

}  // namespace daylit
