#include "gi/transport/path_trace/path_trace.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <mutex>
#include <utility>

#include "gi/transport/path_trace/film.h"
#include "gi/transport/path_trace/integrator.h"

namespace daylit {
namespace {

/// Counts units of work from many threads, reports the share done and takes the wish to stop.
class ProgressCounter {
  public:
    ProgressCounter(Progress progress, double total) : progress_(std::move(progress)), total_(total) {}

    bool stopped() const { return stopped_.load(std::memory_order_relaxed); }
    void add(double units) {
        if (!progress_) return;
        const std::scoped_lock lock(mutex_);
        done_ += units;
        if (!stopped() && !progress_(std::min(done_ / total_, 1.0))) stopped_ = true;
    }
    void throw_if_stopped() const {
        if (stopped()) throw Interrupted{};
    }

  private:
    const Progress progress_;
    double total_, done_ = 0.0;
    std::mutex mutex_;
    std::atomic<bool> stopped_ = false;
};

constexpr int kTile = 16;  // pixels: small enough to share out, large enough to keep rays together

/// Samples that are spread over a pixel together. Large groups have less noise, many groups tell it better.
int group_size(const PathTraceSettings& settings) {
    constexpr int kGroups = 8, kLargest = 1024;
    return std::clamp(int(std::bit_floor(unsigned(settings.spp) / kGroups)), 1, kLargest);
}

/// Samples first .. first + count - 1 of one pixel, group by group.
void add_pixel(Film& film, const Integrator& integrator, const ViewRays& rays, std::uint64_t seed, int x, int y,
               int first, int count, int group_size) {
    const std::uint64_t receiver = std::uint64_t(y) * std::uint64_t(film.width()) + std::uint64_t(x);
    const int end = first + count;
    std::vector<Integrator::CameraStart> starts;
    starts.reserve(Integrator::kWave);
    std::array<Integrator::Sample, Integrator::kWave> samples;
    Film::Group group;
    for (int s = first; s < end;) {
        starts.clear();
        for (int i = s; i < end && starts.size() < Integrator::kWave; ++i) {
            PathRandom random(seed, receiver, std::uint64_t(i), std::uint32_t(group_size));
            const Vec2 place = Vec2(x, y) + random.pair(Net::Pixel);
            starts.push_back({rays.at(place.x, place.y), random});
        }
        const auto wave = std::span(samples).first(starts.size());
        integrator.camera_samples(starts, wave);
        for (const Integrator::Sample& sample : wave) {
            group.add(sample.value, sample.rays);
            if (++s % group_size != 0 && s < end) continue;
            film.add(x, y, group);
            group = {};
        }
    }
}

/// Adds samples first .. first + count - 1 of every pixel; `first` starts a group. Every pixel belongs to one tile, and
/// its samples are added in order, so the sums do not depend on the threads.
void add_round(Film& film, const Integrator& integrator, const ViewRays& rays, std::uint64_t seed, int first, int count,
               int group_size, ProgressCounter& progress) {
    const int tiles_x = (film.width() + kTile - 1) / kTile, tiles_y = (film.height() + kTile - 1) / kTile;
    tbb::parallel_for(tbb::blocked_range<int>(0, tiles_x * tiles_y, 1), [&](const tbb::blocked_range<int>& range) {
        for (int tile = range.begin(); tile != range.end(); ++tile) {
            const int x0 = tile % tiles_x * kTile, y0 = tile / tiles_x * kTile;
            const int x1 = std::min(x0 + kTile, film.width()), y1 = std::min(y0 + kTile, film.height());
            for (int y = y0; y < y1 && !progress.stopped(); ++y) {
                for (int x = x0; x < x1; ++x) add_pixel(film, integrator, rays, seed, x, y, first, count, group_size);
                progress.add(double(x1 - x0) * count);
            }
        }
    });
}

/// Samples still to take so that the error falls to the target: it falls with the square root of their number.
/// At most doubles what there is, since early estimates of the error are rough; whole groups, but for the last.
int next_round(const PathTraceSettings& settings, int spent, double error) {
    const double needed = double(spent) * (error / settings.error) * (error / settings.error) * 1.02;
    const int more = error < 0.0 ? spent : int(std::min(std::ceil(needed) - spent, double(spent)));
    const int group = group_size(settings);
    return std::clamp((more + group - 1) / group * group, 1, settings.max_spp - spent);
}

}  // namespace

PathTraceImage path_trace(const RayScene& rays, const Lighting& lighting, std::span<const PlacedLight> lamps,
                          const View& view, int width, int height, const PathTraceSettings& settings,
                          const Progress& progress) {
    const Integrator integrator(rays, lighting, lamps, settings);
    const ViewRays view_rays(view, width, height);
    Film film(width, height);
    const bool to_error = settings.error > 0.0;
    const int group = group_size(settings);
    int spent = 0, groups = 0;
    int round = std::clamp(settings.spp, to_error ? 2 : 1, std::max(settings.max_spp, 2));
    double error = -1.0;
    while (round > 0) {
        // The total is known only round by round; each report says how much of what is now foreseen is done.
        ProgressCounter counter(
            progress
                ? [&, spent, round](double done) { return progress((spent + done * round) / double(spent + round)); }
                : Progress{},
            double(width) * height * round);
        add_round(film, integrator, view_rays, settings.seed, spent, round, group, counter);
        counter.throw_if_stopped();
        spent += round;
        groups += (round + group - 1) / group;
        error = film.relative_error(spent, groups);
        const bool enough = !to_error || (error >= 0.0 && error <= settings.error) || spent >= settings.max_spp;
        round = enough ? 0 : next_round(settings, spent, error);
    }
    return {.radiance = film.mean(spent),
            .standard_error = film.standard_error(spent, groups),
            .spp = spent,
            .relative_error = error,
            .rays = film.rays()};
}

std::vector<Rgb> path_trace_irradiance(const RayScene& rays, const Lighting& lighting,
                                       std::span<const PlacedLight> lamps, std::span<const SurfaceSample> points,
                                       const PathTraceSettings& settings, const Progress& progress) {
    PathTraceSettings own = settings;
    own.layer = settings.layer == Layer::Final ? Layer::Final : Layer::Indirect;
    const Integrator integrator(rays, lighting, lamps, own);
    std::vector<Rgb> irradiance(points.size());
    const std::uint32_t group = std::bit_ceil(std::uint32_t(settings.spp));
    ProgressCounter counter(progress, double(points.size()));
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 1), [&](const auto& range) {
        std::vector<PathRandom> randoms;
        std::array<Integrator::Sample, Integrator::kWave> samples;
        for (std::size_t i = range.begin(); i != range.end() && !counter.stopped(); ++i) {
            glm::dvec3 sum(0.0);
            for (int s = 0; s < settings.spp;) {
                randoms.clear();
                for (; s < settings.spp && randoms.size() < Integrator::kWave; ++s)
                    randoms.emplace_back(settings.seed, i, std::uint64_t(s), group);
                const auto wave = std::span(samples).first(randoms.size());
                integrator.irradiance_samples(points[i], randoms, wave);
                for (const Integrator::Sample& sample : wave) sum += glm::dvec3(sample.value);
            }
            irradiance[i] = Rgb(sum / double(settings.spp));
            counter.add(1.0);
        }
    });
    counter.throw_if_stopped();
    return irradiance;
}

}  // namespace daylit
