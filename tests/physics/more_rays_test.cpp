// Rays that are added where light is noisy: as many as the noise asks for, and each as good as the first.
#include "gi/transport/day_gather/more_rays.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/base/random.h"
#include "scenes.h"

namespace daylit {
namespace {

// ---- how many ----

constexpr int kFirst = 48;  // rays of every texel
constexpr double kTarget = 0.1, kMost = 8.0;

struct Shares {
    std::vector<float> noise;
    std::vector<bool> wanted;
    std::vector<int> more;

    explicit Shares(double mean) {
        Random random(5, 0, 0);
        for (int t = 0; t < 4000; ++t) {
            noise.push_back(std::exp2(9.0f * random.next() - 6.0f));  // 0.016 to 8
            wanted.push_back(random.next() < 0.9f);
        }
        GatherHits hits;
        hits.rays = kFirst;
        more = share_out_rays(hits, noise, wanted, mean, kTarget, kMost);
    }
    double sum() const { return std::accumulate(more.begin(), more.end(), 0.0); }
    /// Rays to add at which a texel's noise has reached the target, or that are the most it may have.
    double enough(std::size_t t) const {
        const double times = double(noise[t]) / kTarget;
        return std::min(times * times - 1.0, kMost) * kFirst;
    }
};

TEST(ShareOutRays, StaysWithinTheBudgetAndTakesNearlyAllOfIt) {
    for (const double mean : {0.5, 5.0, 32.0, 100.0}) {
        const Shares shares(mean);
        const double budget = mean * double(shares.more.size());
        EXPECT_LE(shares.sum(), budget);
        EXPECT_GE(shares.sum(), budget - double(shares.more.size())) << mean;  // each is rounded down
    }
    EXPECT_EQ(Shares(0.0).sum(), 0.0);
}

TEST(ShareOutRays, NoneBelowTheTargetNorWhereNobodyLooks) {
    const Shares shares(100.0);
    int quiet = 0, unwanted = 0;
    for (std::size_t t = 0; t < shares.more.size(); ++t) {
        if (shares.wanted[t] && double(shares.noise[t]) > kTarget) continue;
        ++(shares.wanted[t] ? quiet : unwanted);
        EXPECT_EQ(shares.more[t], 0);
    }
    EXPECT_GT(quiet, 300);
    EXPECT_GT(unwanted, 300);
}

TEST(ShareOutRays, NeverMoreThanEnoughAndThatWhereThereArePlenty) {
    const Shares some(32.0), plenty(1000.0);
    for (std::size_t t = 0; t < some.more.size(); ++t) {
        if (!some.wanted[t] || double(some.noise[t]) <= kTarget) continue;
        EXPECT_LE(double(some.more[t]), some.enough(t) + 1e-3) << some.noise[t];
        EXPECT_NEAR(double(plenty.more[t]), some.enough(t), 1.0) << some.noise[t];
    }
}

TEST(ShareOutRays, InProportionToTheNoise) {
    const Shares shares(32.0);
    double low = 0.0, high = 1e9;  // rays per noise, between which all must lie
    int uncapped = 0;
    for (std::size_t t = 0; t < shares.more.size(); ++t) {
        if (shares.more[t] == 0 || double(shares.more[t]) > shares.enough(t) - 1.0) continue;
        ++uncapped;
        low = std::max(low, (kFirst + shares.more[t]) / double(shares.noise[t]));
        high = std::min(high, (kFirst + shares.more[t] + 1) / double(shares.noise[t]));
    }
    EXPECT_GT(uncapped, 300);
    EXPECT_LE(low, high * (1.0 + 1e-5));
}

// ---- what they bring ----

/// A room of 4 m with a skylight of a metre: most of the light comes from one patch of floor in the sun. A small lamp
/// shines too. What leaves the surfaces is solved once and taken as given, so all noise is of the gather's.
class Room {
  public:
    Room() {
        add_surfaces();
        rays_.emplace(made_.scene, made_.mesh);
        atlas_ = make_atlas(made_.mesh, 250);
        texels_ = make_texels(made_.mesh, atlas_);
        scene_.emplace(gather_scene(*rays_, atlas_, texels_, {}));
        LightSettings settings;
        settings.sun = SunSource::Given, settings.sun_direction = glm::normalize(Vec3(0.2f, 1, 0.1f));
        settings.sky = SkySource::None;
        const LightModel model(settings, {});
        const GatherSettings how{.rays = 512, .seed = 1000};
        const GatherHits hits = traced(how);
        const std::vector<ByLit> no_lamps(hits.receivers.size());
        day_ = solve_day(*scene_, hits, no_lamps, day_light(model, {12.0}), how, StageProgress{nobody_});
        weights_ = {day_.basis.weights(0, model.scales(12.0, 0.0))};
        light_.emplace(day_);
    }

    std::size_t count() const { return texels_.count(); }
    std::size_t components() const { return day_.basis.components; }
    std::size_t lamps() const { return day_.basis.component_of(StillPart::Lamps); }
    double luminance_of(const std::vector<Rgb>& rows, std::size_t texel) const {
        return double(MomentLight(weights_).of(rows.data() + texel * components())[0]);
    }
    GatherHits traced(const GatherSettings& how) const {
        Checkpoint nowhere;
        return trace_hits(*scene_, how, nowhere, StageProgress{nobody_});
    }
    /// What the hits gather: [texel][component], as the solver's.
    std::vector<Rgb> gathered(const GatherHits& hits) const {
        std::vector<Rgb> rows(count() * components(), Rgb(0.0f));
        for (std::size_t t = 0; t < count(); ++t) {
            Rgb* row = rows.data() + t * components();
            const auto own = std::span(hits.hit).subspan(t * std::size_t(hits.rays), std::size_t(hits.rays));
            for (const std::uint32_t hit : own)
                for (std::size_t i = 0; hit != kNoLight && i < components(); ++i)
                    row[i] += hits.scale[t] * day_.leaves(hits.source(hit))[i];
            row[lamps()] += hits.emission[t].always;
        }
        return rows;
    }
    std::vector<float> noise(const GatherHits& hits, std::vector<Rgb> rows) const {
        DaySolution day = day_;
        day.texels = std::move(rows);
        return texel_noise(hits, day, MomentLight(weights_));
    }
    void add(const GatherHits& hits, std::uint64_t seed, std::span<const int> more, std::vector<Rgb>& rows,
             std::vector<float>& noise) const {
        TexelTilts none;
        gather_more(*scene_, hits, day_, *light_, {.rays = hits.rays, .seed = seed}, more, rows, none, noise,
                    StageProgress{nobody_});
    }

  private:
    void add_surfaces() {
        const std::uint32_t wall = made_.add(lambert(Rgb(0.5f, 0.4f, 0.3f)));
        const std::uint32_t lamp = made_.add(lambert(Rgb(0.0f), Rgb(3000.0f)));
        const Vec3 x(4, 0, 0), y(0, 3, 0), z(0, 0, 4), o(0.0f);
        made_.quad(wall, o, z, x), made_.quad(wall, o, y, z), made_.quad(wall, x, z, y);
        made_.quad(wall, o, x, y), made_.quad(wall, z, y, x);
        for (const float near : {0.0f, 2.5f}) {  // the ceiling about its hole
            made_.quad(wall, y + Vec3(0, 0, near), x, Vec3(0, 0, 1.5f));
            made_.quad(wall, y + Vec3(near, 0, 1.5f), Vec3(1.5f, 0, 0), Vec3(0, 0, 1));
        }
        made_.quad(lamp, Vec3(0.01f, 2, 3), Vec3(0, 0.3f, 0), Vec3(0, 0, 0.3f));
    }

    TestScene made_;
    std::optional<RayScene> rays_;
    Atlas atlas_;
    Texels texels_;
    std::optional<GatherScene> scene_;
    DaySolution day_;
    std::vector<std::vector<Rgb>> weights_;
    std::optional<HalvedLight> light_;
    Progress nobody_;
};

constexpr int kSeeds = 128, kMore = 3 * kFirst;

/// Of one texel over many seeds. Squares are of differences from `truth`, and means.
struct Record {
    double truth = 0.0, at_once = 0.0;           // all rays at once: the mean light, and its square
    double mean = 0.0, first = 0.0, last = 0.0;  // the mean with further rays; squares without and with
    double told_first = 0.0, told_last = 0.0;    // squares, as texel_noise() and gather_more() tell
};

double square(double x) {
    return x * x;
}

std::vector<Record> measured(const Room& room) {
    std::vector<Record> records(room.count());
    std::vector<std::vector<Rgb>> at_once;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        at_once.push_back(room.gathered(room.traced({.rays = kFirst + kMore, .seed = kSeeds + seed})));
        for (std::size_t t = 0; t < records.size(); ++t)
            records[t].truth += room.luminance_of(at_once.back(), t) / kSeeds;
    }
    const std::vector<int> more(room.count(), kMore);
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const GatherHits hits = room.traced({.rays = kFirst, .seed = seed});
        const std::vector<Rgb> first = room.gathered(hits);
        std::vector<Rgb> last = first;
        const std::vector<float> told_first = room.noise(hits, first);
        std::vector<float> told_last = told_first;
        room.add(hits, seed, more, last, told_last);
        for (std::size_t t = 0; t < records.size(); ++t) {
            Record& r = records[t];
            const double light = room.luminance_of(first, t);
            r.mean += room.luminance_of(last, t) / kSeeds;
            r.at_once += square(room.luminance_of(at_once[seed - 1], t) - r.truth) / kSeeds;
            r.first += square(light - r.truth) / kSeeds;
            r.last += square(room.luminance_of(last, t) - r.truth) / kSeeds;
            r.told_first += square(double(told_first[t]) * light) / kSeeds;
            r.told_last += square(double(told_last[t]) * light) / kSeeds;
        }
    }
    return records;
}

class MoreRays : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        room_ = std::make_unique<Room>();
        records_ = measured(*room_);
    }
    static void TearDownTestSuite() { room_.reset(); }
    /// Over the texels, in ascending order.
    template <class Value>
    static std::vector<double> sorted(const Value& value) {
        std::vector<double> result;
        for (const Record& r : records_) result.push_back(value(r));
        std::sort(result.begin(), result.end());
        return result;
    }
    static std::unique_ptr<Room> room_;
    static std::vector<Record> records_;
};
std::unique_ptr<Room> MoreRays::room_;
std::vector<Record> MoreRays::records_;

double quantile(const std::vector<double>& ascending, double share) {
    return ascending[std::size_t(share * double(ascending.size() - 1))];
}

TEST_F(MoreRays, AreWorthWhatTheFirstAreOnAverage) {
    double mean = 0.0, truth = 0.0, variance = 0.0, deviations = 0.0;
    for (const Record& r : records_) {
        const double of_both = (r.at_once + r.last) / kSeeds;
        mean += r.mean, truth += r.truth, variance += of_both;
        deviations += square(r.mean - r.truth) / of_both / double(records_.size());
    }
    EXPECT_LT(std::abs(mean - truth), 4.0 * std::sqrt(variance));  // of all texels
    EXPECT_LT(std::sqrt(variance), 0.003 * truth);                 // so that is little
    EXPECT_NEAR(std::sqrt(deviations), 1.0, 0.2);                  // of each, in standard errors
}

// Independent rays would halve it, since there are four times as many; stratified ones do a little better.
TEST_F(MoreRays, LessenTheErrorByTheRootOfTheirNumber) {
    const auto falls = sorted([](const Record& r) { return std::sqrt(r.last / r.first); });
    EXPECT_GT(quantile(falls, 0.5), 0.4);
    EXPECT_LT(quantile(falls, 0.5), 0.52);
    EXPECT_LT(falls.back(), 0.8);
}

TEST_F(MoreRays, NoiseIsAsItIsTold) {
    const auto first = sorted([](const Record&r) { return std::sqrt(r.told_first / r.first); }),
               last = sorted([](const Record&r) { return std::sqrt(r.told_last / r.last); });
    for (const std::vector<double>& told : {first, last}) {
        EXPECT_GT(told.front(), 0.6);
        EXPECT_GT(quantile(told, 0.5), 1.0);  // as of independent rays
        EXPECT_LT(quantile(told, 0.5), 1.8);
        EXPECT_LT(quantile(told, 0.9), 2.2);
    }
}

TEST_F(MoreRays, OnlyTexelsThatGetSomeChange) {
    const GatherHits hits = room_->traced({.rays = kFirst});
    const std::vector<Rgb> before = room_->gathered(hits);
    const std::vector<float> noise_before = room_->noise(hits, before);
    std::vector<int> more(room_->count(), 0);
    for (std::size_t t = 0; t < more.size(); t += 3) more[t] = 7;
    std::vector<Rgb> rows = before;
    std::vector<float> noise = noise_before;
    room_->add(hits, 1, more, rows, noise);
    for (std::size_t t = 0; t < more.size(); ++t) {
        EXPECT_EQ(noise[t] == noise_before[t], more[t] == 0) << t;
        EXPECT_EQ(room_->luminance_of(rows, t) == room_->luminance_of(before, t), more[t] == 0) << t;
    }
}

// As many as the first: were they the same ones, nothing would change but by rounding.
TEST_F(MoreRays, AreNotTheFirstOnesAgain) {
    const GatherHits hits = room_->traced({.rays = kFirst});
    const std::vector<Rgb> before = room_->gathered(hits);
    std::vector<Rgb> rows = before;
    std::vector<float> noise(room_->count(), 1.0f);
    room_->add(hits, GatherSettings{}.seed, std::vector<int>(room_->count(), kFirst), rows, noise);
    double change = 0.0;
    for (std::size_t t = 0; t < room_->count(); ++t)
        change += std::abs(room_->luminance_of(rows, t) / room_->luminance_of(before, t) - 1.0);
    EXPECT_GT(change / double(room_->count()), 0.1);
}

TEST_F(MoreRays, SameBitsForAnyNumberOfThreads) {
    const GatherHits hits = room_->traced({.rays = kFirst});
    const std::vector<int> more(room_->count(), kFirst);
    const auto with = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::pair<std::vector<Rgb>, std::vector<float>> result{room_->gathered(hits), {}};
        tbb::task_arena(int(threads)).execute([&] {
            result.second = room_->noise(hits, result.first);
            room_->add(hits, 1, more, result.first, result.second);
        });
        return result;
    };
    const auto one = with(1);
    EXPECT_EQ(one, with(2));
    EXPECT_EQ(one, with(5));
}

}  // namespace
}  // namespace daylit
