#include "gi/transport/day_gather/day_columns.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/baked/light_basis.h"

namespace daylit {
namespace {

/// `samples` x `samples` places of a bin, weighed by their solid angle; radiance(u, v) is asked at each.
template <class Radiance>
Rgb mean_of_bin(int bin, int samples, const Radiance& radiance) {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (int y = 0; y < samples; ++y) {
        const int row = bin / kSkyColumns * samples + y;
        const double weight = std::sin(kPi * (row + 0.5) / (kSkyRows * samples));
        for (int x = 0; x < samples; ++x) sum += weight * glm::dvec3(radiance(bin % kSkyColumns * samples + x, row));
        weights += samples * weight;
    }
    return Rgb(sum / weights);
}

/// Hours at which the sky is computed: every twenty minutes while the sun is high, every ten at dusk and dawn, when it
/// dims by half in that time; between them a cubic differs by a thousandth.
std::vector<std::size_t> sky_keyframes(const Day& day, const std::vector<double>& hours) {
    constexpr double kHigh = 8.0 * kDegree, kHighStep = 1.0 / 3.0, kLowStep = 1.0 / 6.0, kSlack = 1e-6;
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < hours.size(); ++k) {
        const double step = sun_position(day, hours[k]).apparent_elevation > kHigh ? kHighStep : kLowStep;
        const double since = result.empty() ? step : hours[k] - hours[result.back()];
        if (since > step - kSlack || k + 1 == hours.size() || hours[k + 1] - hours[result.back()] > step + kSlack)
            result.push_back(k);
    }
    return result;
}

/// K at every hour.
std::vector<std::vector<Rgb>> clear_skies(const LightModel& model, const std::vector<double>& hours) {
    const std::vector<std::size_t> keyframes = sky_keyframes(model.settings().day, hours);
    std::vector<double> at;
    for (std::size_t k : keyframes) at.push_back(hours[k]);
    std::vector<std::vector<Rgb>> computed(keyframes.size()), result(hours.size());
    tbb::parallel_for(std::size_t(0), computed.size(),
                      [&](std::size_t i) { computed[i] = sky_bins(model.clear_sky(at[i])); });
    tbb::parallel_for(std::size_t(0), hours.size(), [&](std::size_t k) {
        result[k].assign(kSkyBins, Rgb(0.0f));
        const CurveBlend blend = curve_blend(at, hours[k]);
        for (std::size_t i = 0; i < blend.share.size(); ++i)
            for (std::size_t bin = 0; bin < kSkyBins && blend.share[i] != 0.0; ++bin)
                result[k][bin] += float(blend.share[i]) * computed[blend.keyframe[i]][bin];
        for (Rgb& radiance : result[k]) radiance = glm::max(radiance, Rgb(0.0f));
    });
    return result;
}

}  // namespace

std::uint32_t sky_bin(const Vec3& direction) {
    const Vec2 uv = latlong_from_direction(direction);
    const int x = std::clamp(int(uv.x * float(kSkyColumns)), 0, kSkyColumns - 1);
    const int y = std::clamp(int(uv.y * float(kSkyRows)), 0, kSkyRows - 1);
    return std::uint32_t(y * kSkyColumns + x);
}

std::vector<Rgb> sky_bins(const Environment& sky) {
    std::vector<Rgb> bins(kSkyBins, Rgb(0.0f));
    if (sky.map.empty()) return bins;
    const Image& map = sky.map;
    const int across = map.width / kSkyColumns;
    const bool whole_pixels = across > 0 && map.width == across * kSkyColumns && map.height == across * kSkyRows;
    // Enough points that none of an image's pixels is missed.
    const int samples = whole_pixels ? across : std::max(4, (map.width + kSkyColumns - 1) / kSkyColumns);
    for (int bin = 0; bin < int(kSkyBins); ++bin)
        bins[std::size_t(bin)] = mean_of_bin(bin, samples, [&](int x, int y) {
            if (whole_pixels) return map.at(x, y);
            return sky.radiance(direction_from_latlong(
                Vec2((float(x) + 0.5f) / float(samples * kSkyColumns), (float(y) + 0.5f) / float(samples * kSkyRows))));
        });
    return bins;
}

DayLight day_light(const LightModel& model, std::vector<double> hours) {
    DayLight light;
    const LightSettings& settings = model.settings();
    DayColumns& columns = light.columns;
    columns.hours = std::move(hours);
    const std::size_t count = columns.hours.size();
    columns.suns = settings.sun == SunSource::Day ? count : model.unit_suns(columns.hours[0]).empty() ? 0 : 1;
    columns.skies = settings.sky == SkySource::Day ? count : model.clear_sky(columns.hours[0]).black() ? 0 : 1;
    for (std::size_t s = 0; s < columns.suns; ++s) light.suns.push_back(model.unit_suns(columns.hours[s]));
    if (columns.skies > 1) light.sky = clear_skies(model, columns.hours);
    if (columns.skies == 1) light.sky.push_back(sky_bins(model.clear_sky(columns.hours[0])));
    for (const Environment* part : {&model.sky_parts().overcast, &model.sky_parts().ground, &model.sky_parts().night})
        light.sky.push_back(sky_bins(*part));
    for (double hour : columns.hours) light.scales.push_back(model.scales(hour, 0.0));
    return light;
}

}  // namespace daylit
