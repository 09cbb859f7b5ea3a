#include "gi/encode/frame_lightmap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daylit {
namespace {

constexpr std::size_t kChannels = 3;

/// A texel's light and its tilts along u and v over kTiltScale.
using TexelLight = std::array<Rgb, 3>;

class Shining {
  public:
    Shining(const LightRows& rows, const TiltRows& tilts, std::span<const Rgb> weights)
        : rows_(rows), tilts_(tilts), weights_(weights) {}

    TexelLight of(std::uint32_t row) const {
        TexelLight light{};
        light[0] = sum(rows_.row(row));
        const std::uint32_t tilt = tilts_.of_row.empty() ? ~0u : tilts_.of_row[row];
        for (std::size_t axis = 0; axis < 2 && tilt != ~0u; ++axis)
            light[1 + axis] =
                sum(tilts_.rows.data() + (2 * std::size_t(tilt) + axis) * weights_.size()) / DayLightmap::kTiltScale;
        return light;
    }

  private:
    Rgb sum(const Rgb* components) const {
        Rgb result(0.0f);
        for (std::size_t r = 0; r < weights_.size(); ++r) result += weights_[r] * components[r];
        return result;
    }

    const LightRows& rows_;
    const TiltRows& tilts_;
    std::span<const Rgb> weights_;
};

float largest(const TexelLight& light) {
    float result = 0.0f;
    for (const Rgb& part : light)
        for (int c = 0; c < 3; ++c) result = std::max(result, std::abs(part[c]));
    return result;
}

/// One component that shines always.
LightBasis constant_basis() {
    LightBasis basis;
    basis.hours = {0.0};
    basis.components = 1;
    basis.curves.assign(basis.columns(), 0.0f);
    basis.curves[basis.still(StillColumn::Lamps)] = 1.0f;
    return basis;
}

}  // namespace

DayLightmap frame_lightmap(DayLightmap map, const LightRows& rows, const TiltRows& tilts,
                           std::span<const std::uint32_t> row_of_pixel, std::span<const Rgb> weights) {
    const Shining moment(rows, tilts, weights);
    map.basis = constant_basis();
    map.tile_patterns.assign(map.tiles(), std::uint8_t(kChannels));
    map.tile_tilted.assign(tilts.of_row.empty() ? 0 : map.tiles(), 1);
    map.patterns.clear();
    for (std::size_t tile = 0; tile < map.tiles(); ++tile)
        for (std::size_t p = 0; p < kChannels; ++p)
            for (std::size_t c = 0; c < kChannels; ++c) map.patterns.push_back(p == c);
    map.values.assign(kChannels * map.texels(), 0);
    map.tilts.assign(map.tile_tilted.empty() ? 0 : 2 * map.values.size(), 0);
    map.exponents.assign(map.texels(), 0);

    const auto tile_of = [&](std::size_t pixel) {
        const auto width = std::size_t(map.width);
        return map.tile_at(int(pixel % width), int(pixel / width));
    };
    std::vector<float> brightest(map.tiles(), 1e-6f);
    for (std::size_t pixel = 0; pixel < row_of_pixel.size(); ++pixel)
        if (row_of_pixel[pixel] != ~0u)
            brightest[tile_of(pixel)] = std::max(brightest[tile_of(pixel)], largest(moment.of(row_of_pixel[pixel])));
    map.scales.clear();
    for (const float light : brightest)
        map.scales.insert(map.scales.end(), kChannels, light / float(DayLightmap::kLargestValue));
    for (std::size_t pixel = 0; pixel < row_of_pixel.size(); ++pixel) {
        if (row_of_pixel[pixel] == ~0u) continue;
        const TexelLight light = moment.of(row_of_pixel[pixel]);
        const float own = std::max(largest(light), 1e-12f), most = brightest[tile_of(pixel)];
        const int exponent = std::clamp(int(std::log2(most / own) / 2.0f), 0, DayLightmap::kLargestExponent);
        map.exponents[pixel] = std::uint8_t(exponent);
        for (std::size_t p = 0; p < kChannels; ++p) {
            const auto stored = [&](std::size_t part) {
                return std::int16_t(std::lround(std::ldexp(light[part][int(p)], 2 * exponent) *
                                                float(DayLightmap::kLargestValue) / most));
            };
            map.values[p * map.texels() + pixel] = stored(0);
            for (std::size_t axis = 0; axis < 2 && !map.tilts.empty(); ++axis)
                map.tilts[(2 * p + axis) * map.texels() + pixel] = stored(1 + axis);
        }
    }
    return map;
}

}  // namespace daylit
