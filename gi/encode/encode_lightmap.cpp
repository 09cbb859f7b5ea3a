#include "gi/encode/encode_lightmap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "gi/encode/halves.h"

namespace daylit {
namespace {

// Luminance times pi to which displays adapt at the least (the floor of auto_ev).
constexpr double kDarkestExposure = 1e-4 * kPi;

DayRows day_rows(const DaySolution& day, std::span<const Keyframe> keyframes, const std::vector<std::uint32_t>& rows) {
    DayRows result;
    result.count = rows.size();
    result.exposure = exposures(day, keyframes);
    std::vector<std::vector<Rgb>> weights;
    for (const Keyframe& keyframe : keyframes) {
        result.hours.push_back(day.basis.columns.hours[keyframe.hour]);
        weights.push_back(day.basis.weights(keyframe.hour, keyframe.scales));
    }
    result.read = [&day, &rows, weights = std::move(weights)](std::size_t row, Rgb* light) {
        const Rgb* components = day.texel(rows[row]);
        for (std::size_t k = 0; k < weights.size(); ++k) {
            light[k] = Rgb(0.0f);
            for (std::size_t r = 0; r < day.basis.components; ++r) light[k] += weights[k][r] * components[r];
        }
    };
    return result;
}

/// Component images of all texels: texel-major, unscaled.
std::vector<Rgb> project_all(const TimeBasis& basis, const DayRows& rows) {
    std::vector<Rgb> result(rows.count * std::size_t(basis.components));
    tbb::parallel_for(std::size_t(0), rows.count, [&](std::size_t row) {
        std::vector<Rgb> keyframes(rows.hours.size());
        rows.read(row, keyframes.data());
        project(basis, keyframes.data(), result.data() + row * std::size_t(basis.components));
    });
    return result;
}

/// For every texel of the atlas the row that it shows; ~0u in gaps between charts.
std::vector<std::uint32_t> row_of_atlas_texel(const Atlas& atlas, const Texels& texels,
                                              const std::vector<std::uint32_t>& row_of_texel) {
    std::vector<std::uint32_t> result(std::size_t(atlas.width) * std::size_t(atlas.height), ~0u);
    tbb::parallel_for(std::size_t(0), atlas.charts.size(), [&](std::size_t id) {
        const PlacedChart& c = atlas.charts[id];
        const std::uint32_t first = texels.first_cell[id];
        const auto row_of_cell = [&](std::size_t cell) {
            const std::uint32_t texel = texels.texel_of_cell[first + cell];
            return texel == kNoTexel ? ~0u : row_of_texel[texel];
        };
        std::vector<bool> lit(std::size_t(c.nx) * std::size_t(c.ny));
        for (std::size_t cell = 0; cell < lit.size(); ++cell) lit[cell] = row_of_cell(cell) != ~0u;
        const std::vector<std::uint32_t> nearest = nearest_usable(c.nx, c.ny, lit);
        for (int y = 0; y < c.atlas_height(); ++y)
            for (int x = 0; x < c.atlas_width(); ++x) {
                const std::uint32_t from = nearest[std::size_t(std::min(y, c.ny - 1)) * std::size_t(c.nx) +
                                                   std::size_t(std::min(x, c.nx - 1))];
                if (from == kNoTexel) continue;  // all of it inside solid geometry: black
                result[std::size_t(c.y + y) * std::size_t(atlas.width) + std::size_t(c.x + x)] = row_of_cell(from);
            }
    });
    return result;
}

}  // namespace

std::vector<double> exposures(const DaySolution& day, std::span<const Keyframe> keyframes) {
    std::vector<double> result;
    for (const Keyframe& keyframe : keyframes)
        result.push_back(std::max(day.mean_luminance(keyframe.hour, keyframe.scales), kDarkestExposure));
    return result;
}

EncodedLightmap encode_lightmap(const Atlas& atlas, const Texels& texels, const DaySolution& day,
                                std::span<const Keyframe> keyframes, const std::vector<bool>& usable,
                                const TimeBasisSettings& settings) {
    std::vector<std::uint32_t> rows, row_of_texel(texels.count(), ~0u);
    for (std::uint32_t t = 0; t < texels.count(); ++t)
        if (usable[t]) row_of_texel[t] = std::uint32_t(rows.size()), rows.push_back(t);
    const DayRows light = day_rows(day, keyframes, rows);
    const TimeBasis basis = fit_time_basis(light, settings);
    const std::vector<Rgb> values = project_all(basis, light);
    const std::vector<float> scale = component_scales(values, basis.components);

    EncodedLightmap result;
    DayLightmap& map = result.map;
    map.width = atlas.width, map.height = atlas.height;
    map.corner_uvs = atlas.corner_uvs;
    map.basis = day_basis(basis, scale);
    const std::size_t components = std::size_t(basis.components);
    const std::vector<std::uint16_t> halves = to_halves(values, scale);

    const std::vector<std::uint32_t> shown = row_of_atlas_texel(atlas, texels, row_of_texel);
    map.components.assign(3 * components * shown.size(), 0);
    for (std::size_t r = 0; r < components; ++r)
        for (std::size_t i = 0; i < shown.size(); ++i)
            if (shown[i] != ~0u)
                std::copy_n(halves.begin() + std::ptrdiff_t(3 * (shown[i] * components + r)), 3,
                            map.components.begin() + std::ptrdiff_t(3 * (r * shown.size() + i)));

    result.error = measure_error(light, map.basis, [&](std::size_t row, std::span<const float> weights) {
        Rgb sum(0.0f);
        for (std::size_t r = 0; r < components; ++r) {
            const std::uint16_t* h = halves.data() + 3 * (row * components + r);
            sum += weights[r] * Rgb(glm::unpackHalf1x16(h[0]), glm::unpackHalf1x16(h[1]), glm::unpackHalf1x16(h[2]));
        }
        return glm::max(sum, Rgb(0.0f));
    });
    return result;
}

}  // namespace daylit
