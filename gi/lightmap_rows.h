#pragma once
// The uncompressed day lightmap of a solution: what lightmap encoders are given.
#include "gi/solved_day.h"

namespace daylit {

struct LightmapRows {
    DayLightmap shape;  // width, height and corner_uvs alone
    LightBasis basis;
    std::vector<Rgb> texels;   // [row][component]: of texels, smoothed; after them of pixels of thin charts (stitch.h)
    TexelTilts tilts;          // of rows
    std::vector<float> noise;  // per texel, relative standard error (texel_noise.h) with all rays, before smoothing
    double more_rays = 0.0;    // mean per texel of those that the noise called for
    std::vector<Moment> moments;
    std::vector<std::uint32_t> row_of_pixel;  // as encode_lightmap() takes it

    LightRows light() const { return {basis, 1, texels, moments}; }
};
/// Takes the solution's texels.
LightmapRows lightmap_rows(SolvedDay& solved, const StageProgress& progress);

}  // namespace daylit
