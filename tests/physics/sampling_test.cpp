// The random numbers and the functions that turn them into directions.
#include "gi/transport/path_trace/sampling.h"

#include <gtest/gtest.h>

#include <set>

#include "gi/transport/path_trace/path_random.h"

namespace daylit {
namespace {

TEST(PathRandom, EveryElementaryIntervalOfAGroupHoldsOneSample) {
    constexpr std::uint32_t kSize = 64;
    for (const Net net : {Net::Pixel, Net::Sun, Net::Bounce})
        for (std::uint64_t receiver = 0; receiver < 20; ++receiver)
            for (std::uint32_t columns = 1; columns <= kSize; columns *= 2) {
                std::set<std::pair<int, int>> cells;
                for (std::uint64_t s = kSize; s < 2 * kSize; ++s) {
                    const Vec2 p = PathRandom(1, receiver, s, kSize).pair(net);
                    ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
                    cells.emplace(int(p.x * float(columns)), int(p.y * float(kSize / columns)));
                }
                EXPECT_EQ(cells.size(), kSize) << columns << " columns, receiver " << receiver;
            }
}

TEST(PathRandom, NetsGroupsAndReceiversAreUniformAndIndependent) {
    // Chi-square over 8^4 cells of two nets of one sample, one place in the group at a time: what is spread evenly
    // within a group must look independent from group to group.
    constexpr int kSide = 8, kCells = kSide * kSide * kSide * kSide, kDraws = 40 * kCells;
    const std::pair<Net, Net> pairs[] = {{Net::Pixel, Net::Sun}, {Net::Lamp, Net::Bounce}, {Net::Emitter, Net::Pixel}};
    for (const auto& [one, other] : pairs)
        for (const bool receivers : {true, false}) {
            std::vector<int> counts(kCells, 0);
            for (std::uint64_t i = 0; i < kDraws; ++i) {
                const PathRandom random(3, receivers ? i : 7, receivers ? 5 : 16 * i + 5, 16);
                const Vec2 a = random.pair(one) * float(kSide), b = random.pair(other) * float(kSide);
                ++counts[std::size_t(((int(a.x) * kSide + int(a.y)) * kSide + int(b.x)) * kSide + int(b.y))];
            }
            double chi_square = 0.0;
            for (const int count : counts) chi_square += (count - 40.0) * (count - 40.0) / 40.0;
            EXPECT_NEAR(chi_square, kCells - 1.0, 4.0 * std::sqrt(2.0 * kCells)) << receivers;
        }
}

TEST(Sampling, AnglesInTurnsAgreeWithTheLibrary) {
    for (int i = -10000; i <= 10000; ++i) {
        const double turns = i / 10000.0;
        const SinCos value = sin_cos_turns(float(turns));
        const double angle = 2.0 * kPi * double(float(turns));
        EXPECT_NEAR(value.sine, std::sin(angle), 2e-7);
        EXPECT_NEAR(value.cosine, std::cos(angle), 2e-7);
        EXPECT_NEAR(turns_of(float(std::sin(angle)), float(std::cos(angle))),
                    std::atan2(float(std::sin(angle)), float(std::cos(angle))) / (2.0 * kPi), 1e-7);
    }
    EXPECT_EQ(turns_of(0.0f, 0.0f), 0.0f);
    EXPECT_EQ(turns_of(0.0f, -1.0f), 0.5f);
    EXPECT_EQ(turns_of(-1.0f, 0.0f), -0.25f);
}

TEST(Sampling, AChoiceStretchesItsNumberToTheWholeRangeAgain) {
    constexpr int kCount = 1000;
    double sums[2] = {0.0, 0.0};
    int counts[2] = {0, 0};
    for (int i = 0; i < kCount; ++i) {
        float u = (float(i) + 0.5f) / kCount;
        const bool chosen = choose(u, 0.3f);
        ASSERT_TRUE(u >= 0.0f && u < 1.0f);
        sums[chosen] += u;
        ++counts[chosen];
    }
    EXPECT_EQ(counts[1], 300);
    EXPECT_NEAR(sums[1] / counts[1], 0.5, 1e-4);
    EXPECT_NEAR(sums[0] / counts[0], 0.5, 1e-4);
    float u = 0.7f;
    EXPECT_FALSE(choose(u, 0.0f));
    EXPECT_EQ(u, 0.7f);
}

}  // namespace
}  // namespace daylit
