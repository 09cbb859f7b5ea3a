// All hours at once. Sun and sky of the whole day are reduced to few components, by principal components of the light
// that a sample of receivers gathers; since gathering mixes rows and reducing mixes columns, the one may come before
// the other, and every bounce of every hour takes the work of these few.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gi/transport/day_gather/bfloat.h"
#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/reduce.h"
#include "gi/transport/day_gather/sun_rows.h"
#include "gi/transport/path_trace/sampling.h"

namespace daylit {
namespace {

constexpr std::size_t kSampleRows = 3072, kCheckRows = 1024;
constexpr int kSampleReach = 2;      // texels about a sampled one
constexpr std::size_t kChunk = 512;  // receivers whose sums belong together, whatever the threads
constexpr std::size_t kAhead = 6;    // rows fetched ahead of their use
// Of many texels fewer components are kept, for memory: so many numbers a channel, but kFewComponents at least.
constexpr std::size_t kMostNumbers = 38'000'000, kFewComponents = 64;

/// Components of a solution, the still parts among them.
std::size_t most_components(std::size_t texels) {
    return std::clamp(kMostNumbers / std::max<std::size_t>(texels, 1), kFewComponents, kMostComponents);
}

/// What shines straight on receivers, before it is known which components are worth keeping.
struct Direct {
    SunRows arcs;           // of the moving sun
    std::vector<Rgb> suns;  // of suns that stand still, lux per receiver
};

class Solver {
  public:
    Solver(const GatherScene& scene, const GatherHits& hits, std::span<const ByLit> lamps, const DayLight& light,
           const GatherSettings& settings)
        : scene_(scene),
          hits_(hits),
          lamps_(lamps),
          light_(light),
          settings_(settings),
          receivers_(hits.receivers.size()) {}

    DaySolution solve(const StageProgress& progress) {
        find_sun(progress.part(0.0, 0.3));
        choose_components();
        start(progress.part(0.3, 0.4));
        bounce_all(progress.part(0.4, 1.0));
        finish();
        return std::move(solution_);
    }

  private:
    std::size_t width() const { return 3 * solution_.basis.components; }
    /// What a receiver reflects of straight light: under a normal map its normals lean, by their mean cosine.
    Rgb of_straight(std::size_t receiver) const {
        const std::size_t texel = hits_.receivers[receiver].texel;
        return scene_.albedo[texel] * scene_.evenness[texel];
    }
    /// Of light from all sides, of which a normal that leans loses half as much (shaders/shared/lightmap.h).
    Rgb of_all_around(std::size_t receiver) const {
        const std::size_t texel = hits_.receivers[receiver].texel;
        return scene_.albedo[texel] * (0.5f + 0.5f * scene_.evenness[texel]);
    }
    std::span<const std::uint32_t> hits_of(std::size_t receiver) const {
        return {hits_.hit.data() + receiver * std::size_t(hits_.rays), std::size_t(hits_.rays)};
    }

    void find_sun(const StageProgress& progress) {
        if (light_.columns.suns == 1) direct_.suns = sun_irradiance(scene_, hits_, light_.suns[0], settings_, progress);
        if (light_.columns.suns > 1)
            direct_.arcs = SunRows(scene_, hits_, light_.columns.hours, light_.suns, settings_, progress);
    }

    // ---- components ----

    /// Receivers spread over all fronts, every other one for checking. Each is the mean of the texels about it in its
    /// chart: light that moves over few rays' hits comes and goes as no light does, and components would be spent on
    /// it.
    SampleRows sample(std::size_t wanted, std::size_t offset) const {
        const std::size_t fronts = scene_.texels.count(), count = std::min(wanted, fronts);
        SampleRows rows{light_.columns.suns + light_.columns.skies, {}};
        rows.values.assign(count * 3 * rows.columns, 0.0f);
        const std::vector<float> sky = sky_by_bins();
        const StageProgress silent{Progress{}};
        for_each_parallel(count, silent, [&](std::size_t i) {
            const std::size_t receiver = ((2 * i + offset) * fronts / (2 * count)) % fronts;
            float lit = 0.0f;
            for_texels_around(scene_.atlas, scene_.texels, std::uint32_t(receiver), kSampleReach, [&](std::uint32_t t) {
                add_light(t, sky, rows.columns, rows.row(i));
                lit += hits_.buried(t) ? 0.0f : 1.0f;
            });
            for (std::size_t k = 0; k < 3 * rows.columns; ++k) rows.row(i)[k] /= std::max(lit, 1.0f);
        });
        return rows;
    }

    /// What a receiver gathers straight from sky and sunlit surfaces, in full.
    void add_light(std::size_t receiver, const std::vector<float>& sky, std::size_t columns, float* row) const {
        for (const std::uint32_t hit : hits_of(receiver)) {
            if (hit == kNoLight) continue;
            if (!(hit & kSkyBit)) {
                add_sun(hit, hits_.scale[receiver], columns, row);
                continue;
            }
            const float* bin = sky.data() + (hit & ~kSkyBit) * 3 * light_.columns.skies;
            for (std::size_t channel = 0; channel < 3; ++channel)
                for (std::size_t k = 0; k < light_.columns.skies; ++k)
                    row[channel * columns + light_.columns.suns + k] +=
                        hits_.scale[receiver] * bin[channel * light_.columns.skies + k];
        }
    }

    /// Reflected sunlight of a receiver, in full.
    void add_sun(std::size_t receiver, float scale, std::size_t columns, float* row) const {
        const Rgb reflected = scale * of_straight(receiver);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            if (!direct_.suns.empty())
                row[channel * columns] += reflected[int(channel)] * direct_.suns[receiver][int(channel)];
            const SunRows::Row arc = direct_.arcs.row(receiver);
            float* to = row + channel * columns + arc.first;
            for (std::size_t k = 0; k < arc.values.size(); ++k) to[k] += reflected[int(channel)] * arc.values[k];
        }
    }

    /// K as pi L: [bin][channel][hour].
    std::vector<float> sky_by_bins() const {
        const std::size_t skies = light_.columns.skies;
        std::vector<float> result(kSkyBins * 3 * skies);
        for (std::size_t bin = 0; bin < kSkyBins; ++bin)
            for (int channel = 0; channel < 3; ++channel)
                for (std::size_t k = 0; k < skies; ++k)
                    result[(bin * 3 + std::size_t(channel)) * skies + k] = kPiF * light_.sky[k][bin][channel];
        return result;
    }

    void choose_components() {
        const SampleRows chosen = sample(kSampleRows, 0);
        const ReductionSettings settings{.most = most_components(scene_.texels.count()) - kStillParts};
        const Reduction reduction = reduce(light_, chosen, sample(kCheckRows, 1), exposures(chosen), settings);
        DayBasisCurves& basis = solution_.basis;
        basis.columns = light_.columns;
        basis.components = reduction.components + kStillParts;
        basis.error = reduction.error;
        basis.curves.assign(basis.components * basis.columns.count(), 0.0f);
        const std::size_t columns = basis.columns.suns + basis.columns.skies;
        for (std::size_t r = 0; r < reduction.components; ++r)
            std::copy_n(reduction.curves.begin() + std::ptrdiff_t(r * columns), columns,
                        basis.curves.begin() + std::ptrdiff_t(r * basis.columns.count()));
        for (std::size_t part = 0; part < kStillParts; ++part)
            basis.curves[(reduction.components + part) * basis.columns.count() + columns + part] = 1.0f;
        project_ = reduction.project;
    }

    /// What the eye is adapted to, lux, roughly: light that a sample gathers, and lamps.
    std::vector<double> exposures(const SampleRows& rows) const {
        std::vector<double> result(light_.columns.hours.size(), 0.0);
        for (std::size_t i = 0; i < rows.count(); ++i) {
            const std::vector<double> hours = clear_day(light_, rows.row(i));
            for (std::size_t k = 0; k < hours.size(); ++k) result[k] += hours[k] / double(rows.count());
        }
        double always = 0.0, evening = 0.0;
        const double share = 1.0 / double(std::max<std::size_t>(scene_.texels.count(), 1));
        for (std::size_t t = 0; t < scene_.texels.count(); ++t) {
            always += share * double(luminance(scene_.albedo[t] * (lamps_[t].always + hits_.emission[t].always)));
            evening += share * double(luminance(scene_.albedo[t] * (lamps_[t].evening + hits_.emission[t].evening)));
        }
        for (std::size_t k = 0; k < result.size(); ++k)
            result[k] = std::max(result[k] + always + double(light_.scales[k].evening) * evening, 1e-4);
        return result;
    }

    // ---- bounces ----

    void start(const StageProgress& progress) {
        solution_.leaving.assign((receivers_ + kSkyBins) * solution_.basis.components, Rgb(0.0f));
        solution_.texels.assign(scene_.texels.count() * solution_.basis.components, Rgb(0.0f));
        current_.assign(solution_.leaving.size() * 3, 0);
        next_.assign(receivers_ * width(), 0);
        for_each_parallel(receivers_, progress, [&](std::size_t r) { start_receiver(r); });
        tbb::parallel_for(std::size_t(0), kSkyBins, [&](std::size_t bin) { start_sky(bin); });
    }

    void start_receiver(std::size_t r) {
        const DayBasisCurves& basis = solution_.basis;
        Rgb* row = solution_.leaving.data() + r * basis.components;
        const std::size_t changing = basis.components - kStillParts;
        std::array<float, kMostComponents> sun{};
        const SunRows::Row arc = direct_.arcs.row(r);
        for (std::size_t k = 0; k < arc.values.size(); ++k) {
            const float* project = project_.data() + (arc.first + k) * changing;
            for (std::size_t i = 0; i < changing; ++i) sun[i] += arc.values[k] * project[i];
        }
        const Rgb straight = of_straight(r), all_around = of_all_around(r);
        for (std::size_t i = 0; i < changing; ++i) {
            row[i] = straight * sun[i];
            if (!direct_.suns.empty()) row[i] += straight * project_[i] * direct_.suns[r];
        }
        const std::size_t evening = basis.component_of(StillPart::Evening),
                          lamps = basis.component_of(StillPart::Lamps);
        const ByLit& emission = hits_.emission[r];
        row[evening] = straight * lamps_[r].evening + all_around * emission.evening;
        row[lamps] = straight * lamps_[r].always + all_around * emission.always;
        if (r < scene_.texels.count()) {
            solution_.texels[r * basis.components + evening] = emission.evening;
            solution_.texels[r * basis.components + lamps] = emission.always;
        }
        send(row, current_.data() + r * width());
    }

    void start_sky(std::size_t bin) {
        const DayBasisCurves& basis = solution_.basis;
        Rgb* row = solution_.leaving.data() + (receivers_ + bin) * basis.components;
        const std::size_t changing = basis.components - kStillParts;
        for (std::size_t k = 0; k < light_.columns.skies; ++k) {
            const float* project = project_.data() + (light_.columns.suns + k) * changing;
            for (std::size_t i = 0; i < changing; ++i) row[i] += project[i] * kPiF * light_.sky[k][bin];
        }
        for (std::size_t part = 0; part < 3; ++part)
            row[changing + part] = kPiF * light_.sky[light_.columns.skies + part][bin];
        send(row, current_.data() + (receivers_ + bin) * width());
    }

    void send(const Rgb* row, std::uint16_t* to) const {
        for (std::size_t i = 0; i < solution_.basis.components; ++i)
            for (int c = 0; c < 3; ++c) to[3 * i + std::size_t(c)] = to_bfloat(row[i][c]);
    }

    void bounce_all(const StageProgress& progress) {
        double at = 0.0;
        for (bool sky = true; solution_.bounces < settings_.bounces; sky = false) {
            const double next = at + 0.3 * (1.0 - at);  // nobody knows how many there will be
            ++solution_.bounces;
            if (bounce(sky, progress.part(at, next)) < settings_.rest) break;
            at = next;
        }
    }

    /// One bounce; returns the share of all indirect light that it brought, the worst hour's.
    double bounce(bool sky, const StageProgress& progress) {
        struct Sums {
            std::vector<double> brought, all;
        };
        std::vector<Sums> sums((receivers_ + kChunk - 1) / kChunk);
        for_each_parallel(
            sums.size(), progress,
            [&](std::size_t chunk) {
                Sums& sum = sums[chunk];
                sum.brought.assign(width(), 0.0), sum.all.assign(width(), 0.0);
                std::array<float, 3 * kMostComponents> row;
                for (std::size_t r = chunk * kChunk; r < std::min((chunk + 1) * kChunk, receivers_); ++r) {
                    gather(r, sky, row.data());
                    reflect(r, row.data(), sum.brought, sum.all);
                }
            },
            16);
        current_.swap(next_);
        std::vector<double> brought(width(), 0.0), all(width(), 0.0);
        for (const Sums& sum : sums)
            for (std::size_t i = 0; i < width(); ++i) brought[i] += sum.brought[i], all[i] += sum.all[i];
        return worst_hour(brought, all);
    }

    void gather(std::size_t r, bool sky, float* sum) const {
        const std::size_t w = width();
        std::fill_n(sum, w, 0.0f);
        const std::span<const std::uint32_t> hits = hits_of(r);
        for (std::size_t j = 0; j < hits.size(); ++j) {
            if (j + kAhead < hits.size() && !(hits[j + kAhead] & kSkyBit)) {
                const std::uint16_t* ahead = current_.data() + hits[j + kAhead] * w;
                for (std::size_t line = 0; line < w; line += 32) __builtin_prefetch(ahead + line);
            }
            if (hits[j] == kNoLight || (!sky && hits[j] & kSkyBit)) continue;
            const std::uint16_t* row = current_.data() + hits_.source(hits[j]) * w;
            for (std::size_t i = 0; i < w; ++i) sum[i] += from_bfloat(row[i]);
        }
        for (std::size_t i = 0; i < w; ++i) sum[i] *= hits_.scale[r];
    }

    /// What was gathered is reflected next.
    void reflect(std::size_t r, const float* gathered, std::vector<double>& brought, std::vector<double>& all) {
        const std::size_t components = solution_.basis.components;
        const bool front = r < scene_.texels.count();
        Rgb* leaving = solution_.leaving.data() + r * components;
        Rgb* texel = front ? solution_.texels.data() + r * components : nullptr;
        std::array<Rgb, kMostComponents> reflected;
        const Rgb albedo = of_all_around(r);
        for (std::size_t i = 0; i < components; ++i) {
            const Rgb light(gathered[3 * i], gathered[3 * i + 1], gathered[3 * i + 2]);
            reflected[i] = albedo * light;
            leaving[i] += reflected[i];
            if (!front) continue;
            texel[i] += light;
            for (int c = 0; c < 3; ++c) {
                brought[3 * i + std::size_t(c)] += double(light[c]);
                all[3 * i + std::size_t(c)] += double(texel[i][c]);
            }
        }
        send(reflected.data(), next_.data() + r * width());
    }

    double worst_hour(const std::vector<double>& brought, const std::vector<double>& all) const {
        double worst = 0.0;
        for (std::size_t k = 0; k < light_.columns.hours.size(); ++k) {
            const std::vector<Rgb> weights = solution_.basis.weights(k, light_.scales[k]);
            double of_this = 0.0, of_all = 0.0;
            for (std::size_t i = 0; i < weights.size(); ++i)
                for (std::size_t c = 0; c < 3; ++c) {
                    of_this += double(weights[i][int(c)]) * brought[3 * i + c];
                    of_all += double(weights[i][int(c)]) * all[3 * i + c];
                }
            if (of_all > 0.0) worst = std::max(worst, of_this / of_all);
        }
        return worst;
    }

    void finish() {
        const DayBasisCurves& basis = solution_.basis;
        std::vector<glm::dvec3> mean(basis.components, glm::dvec3(0.0));
        for (std::size_t t = 0; t < scene_.texels.count(); ++t)
            for (std::size_t i = 0; i < basis.components; ++i)
                mean[i] += glm::dvec3(solution_.leaves(t)[i]) / double(scene_.texels.count());
        solution_.mean_leaving.assign(basis.columns.count(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < basis.components; ++i)
            for (std::size_t c = 0; c < basis.columns.count(); ++c)
                solution_.mean_leaving[c] += double(basis.curve(i, c)) * mean[i];
    }

    const GatherScene& scene_;
    const GatherHits& hits_;
    std::span<const ByLit> lamps_;
    const DayLight& light_;
    const GatherSettings& settings_;
    std::size_t receivers_;
    Direct direct_;
    std::vector<float> project_;  // [column][component]
    DaySolution solution_;
    std::vector<std::uint16_t> current_, next_;  // leaving at this bounce and the next: receivers, then sky bins
};

}  // namespace

DaySolution solve_day(const GatherScene& scene, const GatherHits& hits, std::span<const ByLit> lamps,
                      const DayLight& light, const GatherSettings& settings, const StageProgress& progress) {
    return Solver(scene, hits, lamps, light, settings).solve(progress);
}

}  // namespace daylit
