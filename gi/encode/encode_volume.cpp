#include "gi/encode/encode_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "gi/encode/halves.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr std::size_t kCoefficients = glsl::kShCoefficients;
using Sh = std::array<Rgb, kCoefficients>;

const std::array<Vec3, 6> kSides = {Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                                    Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};

Rgb irradiance(const Sh& sh, const Vec3& normal) {
    const glsl::Sh9 weights = glsl::sh_irradiance_weights(normal);
    Rgb sum(0.0f);
    for (std::size_t i = 0; i < kCoefficients; ++i) sum += weights.c[i] * sh[i];
    return glm::max(sum, Rgb(0.0f));
}

/// A probe's radiance at a keyframe, with what does not change.
Sh at_keyframe(const DayRadiance& day, std::size_t probe, std::size_t k) {
    Sh sh = day.row(probe)[k];
    for (std::size_t i = 0; i < kCoefficients; ++i) sh[i] += day.row(probe)[day.columns - 1][i];
    return sh;
}

/// What is judged: irradiance on six sides of every free probe.
DayRows day_rows(const DayRadiance& day, const std::vector<std::uint32_t>& free, std::span<const double> hours,
                 std::span<const double> exposure) {
    DayRows rows;
    rows.count = kSides.size() * free.size();
    rows.hours.assign(hours.begin(), hours.end());
    rows.exposure.assign(exposure.begin(), exposure.end());
    rows.read = [&day, &free](std::size_t row, Rgb* keyframes) {
        for (std::size_t k = 0; k + 1 < day.columns; ++k)
            keyframes[k] = irradiance(at_keyframe(day, free[row / kSides.size()], k), kSides[row % kSides.size()]);
    };
    return rows;
}

/// Component coefficients of every free probe: [probe][coefficient][component].
std::vector<Rgb> project_all(const TimeBasis& basis, const DayRadiance& day, const std::vector<std::uint32_t>& free) {
    const std::size_t components = std::size_t(basis.components), keyframes = basis.hours.size();
    std::vector<Rgb> result(free.size() * kCoefficients * components);
    tbb::parallel_for(std::size_t(0), free.size(), [&](std::size_t f) {
        std::vector<Sh> sh;
        for (std::size_t k = 0; k < keyframes; ++k) sh.push_back(at_keyframe(day, free[f], k));
        std::vector<Rgb> series(keyframes);
        for (std::size_t i = 0; i < kCoefficients; ++i) {
            for (std::size_t k = 0; k < keyframes; ++k) series[k] = sh[k][i];
            project(basis, series.data(), result.data() + (f * kCoefficients + i) * components);
        }
    });
    return result;
}

/// For every probe of the grid the free one whose light it shows: itself, or one of the nearest, by breadth-first
/// search over six neighbours. Between several the darkest: a wall's probes then show its darker side, since in a dark
/// room leaked daylight is seen, and missing skylight at a bright wall is not. ~0u everywhere when none is free.
std::vector<std::uint32_t> shown_probes(const ProbeGrid& grid, const std::vector<std::uint32_t>& free_of_probe,
                                        const std::vector<double>& brightness) {
    std::vector<std::uint32_t> shown = free_of_probe;
    const std::array<std::size_t, 3> stride = {1, std::size_t(grid.size[0]),
                                               std::size_t(grid.size[0]) * std::size_t(grid.size[1])};
    bool changed = true;
    while (changed) {
        changed = false;
        std::vector<std::uint32_t> next = shown;
        for (std::size_t p = 0; p < shown.size(); ++p) {
            if (shown[p] != ~0u) continue;
            for (std::size_t a = 0; a < 3; ++a) {
                const std::size_t at = p / stride[a] % std::size_t(grid.size[a]);
                for (const bool up : {false, true}) {
                    if (up ? at + 1 == std::size_t(grid.size[a]) : at == 0) continue;
                    const std::uint32_t other = shown[up ? p + stride[a] : p - stride[a]];
                    if (other == ~0u || (next[p] != ~0u && brightness[next[p]] <= brightness[other])) continue;
                    next[p] = other;
                    changed = true;
                }
            }
        }
        shown = std::move(next);
    }
    return shown;
}

/// Mean over the day of what a free probe gets from all sides, as the adapted eye sees it.
std::vector<double> brightness_of(const DayRows& rows) {
    std::vector<double> result(rows.count / kSides.size(), 0.0);
    std::vector<Rgb> keyframes(rows.hours.size());
    for (std::size_t row = 0; row < rows.count; ++row) {
        rows.read(row, keyframes.data());
        for (std::size_t k = 0; k < keyframes.size(); ++k)
            result[row / kSides.size()] += luminance(keyframes[k]) / rows.exposure[k];
    }
    return result;
}

}  // namespace

EncodedVolume encode_volume(const ProbeGrid& grid, const ProbeHits& probes, const DayRadiance& day,
                            std::span<const double> hours, std::span<const double> exposure,
                            const TimeBasisSettings& settings) {
    std::vector<std::uint32_t> free, free_of_probe(grid.count(), ~0u);
    for (std::uint32_t p = 0; p < probes.count(); ++p)
        if (!probes.buried[p]) free_of_probe[grid.wanted[p]] = std::uint32_t(free.size()), free.push_back(p);

    const DayRows rows = day_rows(day, free, hours, exposure);
    const TimeBasis basis = fit_time_basis(rows, settings);
    const std::size_t components = std::size_t(basis.components);
    const std::vector<Rgb> values = project_all(basis, day, free);
    const std::vector<float> scale = component_scales(values, basis.components);
    const std::vector<std::uint16_t> halves = to_halves(values, scale);

    EncodedVolume result;
    result.buried = probes.count() - free.size();
    IrradianceVolume& volume = result.volume;
    volume.origin = grid.origin, volume.spacing = grid.spacing, volume.size = grid.size;
    volume.basis = day_basis(basis, scale);
    const std::vector<std::uint32_t> shown = shown_probes(grid, free_of_probe, brightness_of(rows));
    volume.components.assign(3 * kCoefficients * components * shown.size(), 0);
    for (std::size_t r = 0; r < components; ++r)
        for (std::size_t i = 0; i < kCoefficients; ++i)
            for (std::size_t p = 0; p < shown.size(); ++p)
                if (shown[p] != ~0u)
                    std::copy_n(
                        halves.begin() + std::ptrdiff_t(3 * ((shown[p] * kCoefficients + i) * components + r)), 3,
                        volume.components.begin() + std::ptrdiff_t(3 * ((r * kCoefficients + i) * shown.size() + p)));

    result.error = measure_error(rows, volume.basis, [&](std::size_t row, std::span<const float> weights) {
        const Vec3& side = kSides[row % kSides.size()];
        const std::uint32_t probe = grid.wanted[free[row / kSides.size()]];
        return volume.irradiance(grid.position(probe), side, weights);
    });
    return result;
}

}  // namespace daylit
