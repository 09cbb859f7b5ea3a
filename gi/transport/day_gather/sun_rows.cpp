#include "gi/transport/day_gather/sun_rows.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <optional>

#include "engine/base/random.h"
#include "gi/transport/day_gather/places.h"
#include "gi/transport/day_gather/sequence.h"
#include "gi/transport/day_gather/streams.h"

namespace daylit {
namespace {

constexpr std::size_t kSamples = 4;   // places on the receiver, each with its own place on the sun's disc
constexpr double kSparseHours = 1.0;  // between first tests; the samples' tests lie between one another's
constexpr float kUnknown = -1.0f;
constexpr std::size_t kNone = ~std::size_t(0);

/// One receiver's day.
class Arc {
  public:
    Arc(const GatherScene& scene, std::span<const std::optional<Frame>> suns, std::size_t stride)
        : scene_(scene), suns_(suns), stride_(stride) {
        for (auto& seen : seen_) seen.resize(suns.size());
        for (auto& cosine : cosine_) cosine.resize(suns.size());
    }

    /// Fills lit() for one receiver; false when the sun never comes.
    bool trace(const UsablePoints& points, Random& random) {
        for (std::size_t m = 0; m < kSamples; ++m) {
            // Stratified over the points and the rings of the disc; the same at every hour, so that noise stands still.
            place_[m] = points.any((float(m) + random.next()) / float(kSamples));
            disc_[m] =
                sample_sun_disc(Vec2((float((m * 3) % kSamples) + random.next()) / float(kSamples), random.next()));
            find_facing(m);
        }
        for (std::size_t m = 0; m < kSamples; ++m) test_sparsely(m);
        sparse_ = seen_;
        bool any = false;
        for (const auto& seen : sparse_) any |= std::any_of(seen.begin(), seen.end(), [](float v) { return v > 0.0f; });
        if (!any) return false;
        for (std::size_t m = 0; m < kSamples; ++m) refine(m);
        return true;
    }
    float at(std::size_t hour) const {
        float sum = 0.0f;
        for (std::size_t m = 0; m < kSamples; ++m) sum += seen_[m][hour] * cosine_[m][hour];
        return sum / float(kSamples);
    }
    std::size_t tests() const { return tests_; }

  private:
    Vec3 direction(std::size_t m, std::size_t hour) const { return suns_[hour]->to_world(disc_[m]); }

    /// Hours behind the receiver's horizon need no test.
    void find_facing(std::size_t m) {
        for (std::size_t h = 0; h < suns_.size(); ++h) {
            cosine_[m][h] = 0.0f, seen_[m][h] = 0.0f;
            if (!suns_[h]) continue;
            cosine_[m][h] = std::max(glm::dot(direction(m, h), place_[m].normal), 0.0f);
            if (cosine_[m][h] > 0.0f) seen_[m][h] = kUnknown;
        }
    }

    float test(std::size_t m, std::size_t hour) {
        if (seen_[m][hour] != kUnknown) return seen_[m][hour];
        ++tests_;
        const Vec3 towards = direction(m, hour);
        const Vec3 origin = RayScene::offset_origin(place_[m].position, place_[m].normal, towards);
        return seen_[m][hour] = scene_.rays.transmittance({origin, towards});
    }

    bool facing(std::size_t m, std::size_t hour) const { return cosine_[m][hour] > 0.0f; }

    /// Every stride'th hour, and both ends of each stretch in which the receiver faces the sun.
    void test_sparsely(std::size_t m) {
        const std::size_t shift = m * stride_ / kSamples;
        for (std::size_t h = 0; h < suns_.size(); ++h) {
            if (!facing(m, h)) continue;
            const bool end = h == 0 || h + 1 == suns_.size() || !facing(m, h - 1) || !facing(m, h + 1);
            if (end || h % stride_ == shift) test(m, h);
        }
    }

    void refine(std::size_t m) {
        std::size_t before = kNone;
        for (std::size_t h = 0; h < suns_.size(); ++h) {
            if (!facing(m, h)) before = kNone;
            if (!facing(m, h) || sparse_[m][h] == kUnknown) continue;
            if (before != kNone) between(m, before, h);
            before = h;
        }
    }

    /// Fills the hours between two tested ones: alike where nothing speaks against it, else halved.
    void between(std::size_t m, std::size_t a, std::size_t b) {
        if (b - a < 2) return;
        const float seen = seen_[m][a];
        if (seen == seen_[m][b] && (seen == 0.0f || seen == 1.0f) && others_agree(a, b, seen)) {
            std::fill(seen_[m].begin() + std::ptrdiff_t(a) + 1, seen_[m].begin() + std::ptrdiff_t(b), seen);
            return;
        }
        const std::size_t middle = (a + b) / 2;
        test(m, middle);
        between(m, a, middle);
        between(m, middle, b);
    }

    bool others_agree(std::size_t a, std::size_t b, float seen) const {
        for (std::size_t m = 0; m < kSamples; ++m)
            for (std::size_t h = a + 1; h < b; ++h)
                if (sparse_[m][h] != kUnknown && facing(m, h) && sparse_[m][h] != seen) return false;
        return true;
    }

    const GatherScene& scene_;
    std::span<const std::optional<Frame>> suns_;  // per hour: z towards the sun
    std::size_t stride_, tests_ = 0;
    std::array<Place, kSamples> place_;
    std::array<Vec3, kSamples> disc_;                                  // places on the disc, in the sun's frame
    std::array<std::vector<float>, kSamples> seen_, sparse_, cosine_;  // per hour
};

std::size_t stride_of(std::span<const double> hours) {
    if (hours.size() < 2) return 1;
    const double step = (hours.back() - hours.front()) / double(hours.size() - 1);
    return std::max<std::size_t>(1, std::size_t(kSparseHours / step + 0.5));
}

}  // namespace

SunRows::SunRows(const GatherScene& scene, const GatherHits& hits, std::span<const double> hours,
                 std::span<const std::vector<Sun>> suns, const GatherSettings& settings, const StageProgress& progress)
    : places_(hits.receivers.size()), chunks_((places_.size() + kChunk - 1) / kChunk) {
    const std::size_t stride = stride_of(hours);
    std::vector<std::optional<Frame>> frames(suns.size());
    for (std::size_t h = 0; h < suns.size(); ++h)
        if (!suns[h].empty()) frames[h].emplace(suns[h][0].direction);
    std::atomic<std::size_t> tests = 0;
    for_each_parallel(
        chunks_.size(), progress,
        [&](std::size_t c) {
            Arc arc(scene, frames, stride);
            for (std::size_t r = c * kChunk; r < std::min((c + 1) * kChunk, places_.size()); ++r) {
                const UsablePoints points(scene, hits, r);
                Random random(settings.seed, r, kSunStream);
                if (hits.buried(r) || points.empty() || !arc.trace(points, random)) continue;
                std::size_t first = suns.size(), last = 0;
                for (std::size_t h = 0; h < suns.size(); ++h)
                    if (arc.at(h) > 0.0f) first = std::min(first, h), last = h + 1;
                if (first >= last) continue;
                places_[r] = {std::uint32_t(chunks_[c].size()), std::uint16_t(first), std::uint16_t(last - first)};
                for (std::size_t h = first; h < last; ++h) chunks_[c].push_back(arc.at(h));
            }
            tests += arc.tests();
        },
        16);
    tests_ = tests;
}

SunRows::Row SunRows::row(std::size_t receiver) const {
    if (places_.empty()) return {};
    const Place& place = places_[receiver];
    return {place.first, {chunks_[receiver / kChunk].data() + place.begin, place.count}};
}

}  // namespace daylit
