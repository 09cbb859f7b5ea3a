#include "gi/encode/encode_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "gi/encode/halves.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

constexpr std::size_t kCoefficients = glsl::kShCoefficients;
// Luminance times pi to which displays adapt at the least (the floor of auto_ev).
constexpr double kDarkestExposure = 1e-4 * kPi;
using Sh = std::array<Rgb, kCoefficients>;

const std::array<Vec3, 6> kSides = {Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                                    Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};

Rgb irradiance(const Sh& sh, const Vec3& normal) {
    const glsl::Sh9 weights = glsl::sh_irradiance_weights(normal);
    Rgb sum(0.0f);
    for (std::size_t i = 0; i < kCoefficients; ++i) sum += weights.c[i] * sh[i];
    return glm::max(sum, Rgb(0.0f));
}

/// The SH of every free probe at every keyframe.
struct ProbeDay {
    std::size_t keyframes = 0;
    std::vector<Sh> sh;  // [free probe][keyframe]
    const Sh& at(std::size_t probe, std::size_t k) const { return sh[probe * keyframes + k]; }
};

ProbeDay probe_day(const DaySolution& day, const ProbeHits& probes, std::span<const Keyframe> keyframes,
                   const std::vector<std::uint32_t>& free) {
    std::vector<std::vector<Rgb>> weights;
    for (const Keyframe& keyframe : keyframes) weights.push_back(day.basis.weights(keyframe.hour, keyframe.scales));
    ProbeDay result{keyframes.size(), std::vector<Sh>(free.size() * keyframes.size())};
    tbb::parallel_for(std::size_t(0), free.size(), [&](std::size_t f) {
        const std::vector<Rgb> sh = gather_probe(day, probes, free[f]);
        const std::size_t components = day.basis.components;
        for (std::size_t k = 0; k < keyframes.size(); ++k)
            for (std::size_t i = 0; i < kCoefficients; ++i) {
                Rgb& sum = result.sh[f * keyframes.size() + k][i] = Rgb(0.0f);
                for (std::size_t r = 0; r < components; ++r) sum += weights[k][r] * sh[i * components + r];
            }
    });
    return result;
}

/// What is judged: irradiance on six sides of every free probe.
DayRows day_rows(const ProbeDay& light, std::size_t free, const DaySolution& day, std::span<const Keyframe> keyframes) {
    DayRows rows;
    rows.count = kSides.size() * free;
    for (const Keyframe& keyframe : keyframes) rows.hours.push_back(day.basis.columns.hours[keyframe.hour]);
    for (const Keyframe& keyframe : keyframes)
        rows.exposure.push_back(std::max(day.mean_luminance(keyframe.hour, keyframe.scales), kDarkestExposure));
    rows.read = [&light](std::size_t row, Rgb* values) {
        for (std::size_t k = 0; k < light.keyframes; ++k)
            values[k] = irradiance(light.at(row / kSides.size(), k), kSides[row % kSides.size()]);
    };
    return rows;
}

/// Component coefficients of every free probe: [probe][coefficient][component].
std::vector<Rgb> project_all(const TimeBasis& basis, const ProbeDay& light, std::size_t free) {
    const std::size_t components = std::size_t(basis.components), keyframes = basis.hours.size();
    std::vector<Rgb> result(free * kCoefficients * components);
    tbb::parallel_for(std::size_t(0), free, [&](std::size_t f) {
        std::vector<Rgb> series(keyframes);
        for (std::size_t i = 0; i < kCoefficients; ++i) {
            for (std::size_t k = 0; k < keyframes; ++k) series[k] = light.at(f, k)[i];
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

EncodedVolume encode_volume(const ProbeGrid& grid, const ProbeHits& probes, const DaySolution& day,
                            std::span<const Keyframe> keyframes, const TimeBasisSettings& settings) {
    std::vector<std::uint32_t> free, free_of_probe(grid.count(), ~0u);
    for (std::uint32_t p = 0; p < probes.count(); ++p)
        if (!probes.buried[p]) free_of_probe[grid.wanted[p]] = std::uint32_t(free.size()), free.push_back(p);

    const ProbeDay light = probe_day(day, probes, keyframes, free);
    const DayRows rows = day_rows(light, free.size(), day, keyframes);
    const TimeBasis basis = fit_time_basis(rows, settings);
    const std::size_t components = std::size_t(basis.components);
    const std::vector<Rgb> values = project_all(basis, light, free.size());
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
