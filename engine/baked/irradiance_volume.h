#pragma once
// Indirect light in free space over the day, for what moves: probes of radiance SH on a uniform grid.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/baked/day_basis.h"
#include "engine/base/units.h"

namespace daylit {

/// Probe (x, y, z) stands at origin + spacing * (x, y, z). Each holds the SH coefficients (shaders/shared/sh.h) of
/// *indirect* radiance: what comes from sky and surfaces, not straight from suns and lamps. Probes inside solid
/// geometry hold the light of free neighbours, so that interpolation needs no exceptions.
struct IrradianceVolume {
    Vec3 origin = Vec3(0.0f);
    float spacing = 1.0f;  // metres
    std::array<int, 3> size = {1, 1, 1};
    DayBasis basis;
    /// RGB halves, [basis.components][9][z][y][x]; cd/m^2 once multiplied by the weights.
    std::vector<std::uint16_t> components;

    std::size_t probes() const { return std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]); }
    Vec3 position(int x, int y, int z) const { return origin + spacing * Vec3(x, y, z); }

    /// *Indirect* irradiance in lux at a place on a plane with this unit normal: trilinear, as at the border outside,
    /// never negative; weights = basis.weights(hour). Same as the shader's look-up.
    Rgb irradiance(const Vec3& place, const Vec3& normal, std::span<const float> weights) const;

    /// The SH of one hour, [9][z][y][x]: what the runtime uploads.
    std::vector<Rgb> combined(std::span<const float> weights) const;
};

}  // namespace daylit
