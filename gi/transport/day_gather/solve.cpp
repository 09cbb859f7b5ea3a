// All hours as columns of one matrix: each bounce is one application of the kept hits.
#include <algorithm>
#include <array>
#include <cmath>

#include "gi/transport/day_gather/day_gather.h"
#include "shaders/shared/sh.h"

namespace daylit {
namespace {

// Columns that are bounced together: a row of 16 RGB floats is three cache lines, enough to pay for fetching it.
constexpr std::size_t kBlock = 16;
using Row = std::array<Rgb, kBlock>;

Row black() {
    Row row;
    row.fill(Rgb(0.0f));
    return row;
}

/// sum += factor * row, as one stretch of floats, which compilers vectorise.
void add_scaled(float factor, const Row& row, Row& sum) {
    const float* from = &row[0].x;
    float* to = &sum[0].x;
    for (std::size_t i = 0; i < 3 * kBlock; ++i) to[i] += factor * from[i];
}

/// Up to kBlock columns on their way through the bounces.
class Block {
  public:
    Block(const GatherScene& scene, const GatherHits& hits, const GatherSettings& settings)
        : scene_(scene), hits_(hits), settings_(settings), receivers_(hits.receivers.size()),
          gathered_(receivers_, black()), indirect_(receivers_, black()) {}

    /// Fills the light that leaves receivers and sky before any bounce, as lux (pi L).
    void start(std::span<const Lighting> hours, bool constant_last, std::span<const Rgb> lamps,
               const StageProgress& progress) {
        const std::vector<Rgb> any_bins = sky_bins(Environment{});
        leaving_.assign(receivers_ + any_bins.size(), black());
        for (std::size_t c = 0; c < hours.size(); ++c) {
            const std::vector<Rgb> bins = sky_bins(hours[c].sky);
            for (std::size_t b = 0; b < bins.size(); ++b) leaving_[receivers_ + b][c] = float(kPi) * bins[b];
        }
        for_each_parallel(receivers_, progress, [&](std::size_t r) {
            Row direct = black();
            add_sun_irradiance(scene_, hits_, hours, settings_, r, direct.data());
            if (constant_last) {
                direct[hours.size()] = lamps[r] + hits_.emission[r];
                indirect_[r][hours.size()] = hits_.emission[r];
            }
            const Rgb albedo = scene_.albedo[hits_.receivers[r].texel];
            for (std::size_t c = 0; c < kBlock; ++c) leaving_[r][c] = albedo * direct[c];
        });
        count_leaving();
    }

    /// Sums from now on all that leaves receivers and sky, for probes to gather at the end.
    void keep_all() { all_leaving_ = leaving_; }

    /// SH of radiance at a probe, by what its rays met; sh holds kBlock rows.
    void gather(const ProbeHits& probes, std::size_t p, std::array<std::array<Rgb, 9>, kBlock>& sh) const {
        std::array<Row, 9> sum;
        sum.fill(black());
        const std::size_t first = p * std::size_t(probes.rays);
        for (std::size_t j = first; j < first + std::size_t(probes.rays); ++j) {
            const std::uint32_t hit = probes.hit[j];
            if (hit == kNoLight) continue;
            const Row& row = all_leaving_[hit & kSkyBit ? receivers_ + (hit & ~kSkyBit) : hit];
            const glsl::Sh9 basis = glsl::sh_basis(probes.direction[j]);
            for (std::size_t i = 0; i < 9; ++i)
                add_scaled(basis.c[i], row, sum[i]);
        }
        // Each ray stands for 4 pi / rays of solid angle; what leaves is stored as lux, pi L.
        const float scale = 4.0f / float(probes.rays);
        for (std::size_t i = 0; i < 9; ++i)
            for (std::size_t c = 0; c < kBlock; ++c) sh[c][i] = scale * sum[i][c];
    }

    /// One bounce; returns the share of all indirect light that it brought, the worst column's.
    double bounce(const StageProgress& progress) {
        for_each_parallel(receivers_, progress, [&](std::size_t r) {
            Row sum = black();
            const std::uint32_t* hit = hits_.hit.data() + r * std::size_t(hits_.rays);
            for (int j = 0; j < hits_.rays; ++j) {
                if (hit[j] == kNoLight) continue;
                const std::size_t from = hit[j] & kSkyBit ? receivers_ + (hit[j] & ~kSkyBit) : hit[j];
                const Row& row = leaving_[from];
                for (std::size_t c = 0; c < kBlock; ++c) sum[c] += row[c];
            }
            for (std::size_t c = 0; c < kBlock; ++c) gathered_[r][c] = hits_.scale[r] * sum[c];
        });
        return turn_round();
    }

    const Row& indirect(std::size_t receiver) const { return indirect_[receiver]; }
    /// Mean luminance of what leaves the fronts, so far, per column.
    const std::array<double, kBlock>& mean_leaving() const { return mean_leaving_; }

  private:
    /// What was gathered is reflected next; the sky shines only once.
    double turn_round() {
        std::array<double, kBlock> brought{}, all{};
        for (std::size_t r = 0; r < receivers_; ++r) {
            const Rgb albedo = scene_.albedo[hits_.receivers[r].texel];
            for (std::size_t c = 0; c < kBlock; ++c) {
                indirect_[r][c] += gathered_[r][c];
                leaving_[r][c] = albedo * gathered_[r][c];
                brought[c] += luminance(gathered_[r][c]);
                all[c] += luminance(indirect_[r][c]);
            }
        }
        for (std::size_t r = 0; r < std::min(receivers_, all_leaving_.size()); ++r)
            for (std::size_t c = 0; c < kBlock; ++c) all_leaving_[r][c] += leaving_[r][c];
        std::fill(leaving_.begin() + std::ptrdiff_t(receivers_), leaving_.end(), black());
        count_leaving();
        double worst = 0.0;
        for (std::size_t c = 0; c < kBlock; ++c)
            if (all[c] > 0.0) worst = std::max(worst, brought[c] / all[c]);
        return worst;
    }

    void count_leaving() {
        for (std::size_t t = 0; t < scene_.texels.count(); ++t)
            for (std::size_t c = 0; c < kBlock; ++c)
                mean_leaving_[c] += luminance(leaving_[t][c]) / double(scene_.texels.count());
    }

    const GatherScene& scene_;
    const GatherHits& hits_;
    const GatherSettings& settings_;
    std::size_t receivers_;
    std::vector<Row> leaving_, all_leaving_;  // receivers, then sky bins
    std::vector<Row> gathered_, indirect_;
    std::array<double, kBlock> mean_leaving_{};
};

void gather_probes(const Block& block, const ProbeHits& probes, std::size_t first, std::size_t last, DayRadiance& day) {
    const StageProgress silent{Progress{}};
    for_each_parallel(probes.count(), silent, [&](std::size_t p) {
        std::array<std::array<Rgb, 9>, kBlock> sh;
        block.gather(probes, p, sh);
        std::copy_n(sh.begin(), last - first, day.row(p) + first);
        if (last == day.columns)
            for (std::size_t i = 0; i < 9; ++i) day.row(p)[last - 1][i] += probes.emission[p][i];
    });
}

}  // namespace

DaySolution solve_day(const GatherScene& scene, const GatherHits& hits, const ProbeHits& probes,
                      std::span<const Rgb> lamps, std::span<const Lighting> hours, const GatherSettings& settings,
                      const StageProgress& progress) {
    DaySolution solution;
    DayIrradiance& day = solution.texels;
    day.columns = hours.size() + 1;
    day.rows.assign(scene.texels.count() * day.columns, Rgb(0.0f));
    day.mean_total.assign(day.columns, 0.0);
    solution.probes.columns = day.columns;
    solution.probes.sh.resize(probes.count() * day.columns);
    for (std::size_t first = 0; first < day.columns; first += kBlock) {
        const std::size_t last = std::min(first + kBlock, day.columns);
        const bool constant_last = last == day.columns;
        const double width = progress.end - progress.begin, share = 1.0 / double(day.columns);
        const double begin = progress.begin + width * share * double(first), end = progress.begin + width * share * double(last);
        const double middle = 0.4 * begin + 0.6 * end;
        Block block(scene, hits, settings);
        block.start(hours.subspan(first, last - first - constant_last), constant_last, lamps,
                    {progress.report, begin, middle});
        if (probes.count() > 0) block.keep_all();
        int bounces = 0;
        while (bounces < settings.bounces) {
            const double at = end - (end - middle) * std::pow(0.7, bounces), next = end - (end - middle) * std::pow(0.7, bounces + 1);
            ++bounces;
            if (block.bounce({progress.report, at, next}) < settings.rest) break;
        }
        day.bounces = std::max(day.bounces, bounces);
        for (std::size_t t = 0; t < scene.texels.count(); ++t)
            std::copy_n(block.indirect(t).begin(), last - first, day.row(t) + first);
        gather_probes(block, probes, first, last, solution.probes);
        for (std::size_t c = first; c < last; ++c) day.mean_total[c] = block.mean_leaving()[c - first];
    }
    return solution;
}

}  // namespace daylit
