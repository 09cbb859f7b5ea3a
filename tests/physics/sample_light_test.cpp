// A sample's numbers at half the bytes of floats.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/random.h"
#include "gi/encode/sample_light.h"

namespace daylit {
namespace {

constexpr std::size_t kParts = 4, kNumbers = 150;  // no multiple of a run

/// Numbers of all sizes: every part and run of them a thousand times as large as the one before.
std::vector<float> all_sizes() {
    std::vector<float> light;
    Random random(1, 2, 3);
    for (std::size_t part = 0; part < kParts; ++part)
        for (std::size_t i = 0; i < kNumbers; ++i)
            light.push_back((2.0f * random.next() - 1.0f) *
                            std::pow(1000.0f, float(part + i / SampleLight::kRun) - 3.0f));
    return light;
}

TEST(SampleLight, errs_by_little_of_a_runs_largest) {
    const std::vector<float> light = all_sizes();
    const SampleLight kept(light, kParts);
    for (std::size_t part = 0; part < kParts; ++part)
        for (std::size_t first = 0; first < kNumbers; first += SampleLight::kRun) {
            std::vector<double> found(std::min(SampleLight::kRun, kNumbers - first));
            kept.read(part, first, found);
            double largest = 0.0, wrong = 0.0;
            for (std::size_t i = 0; i < found.size(); ++i) {
                const double stated = double(light[part * kNumbers + first + i]);
                largest = std::max(largest, std::abs(stated));
                wrong = std::max(wrong, std::abs(found[i] - stated));
            }
            EXPECT_GT(largest, 0.0);
            EXPECT_LE(wrong, 2e-5 * largest) << "part " << part << ", number " << first;
        }
}

TEST(SampleLight, gives_any_length_from_a_runs_start) {
    const std::vector<float> light = all_sizes();
    const SampleLight kept(light, kParts);
    std::vector<double> all(kNumbers), some(SampleLight::kRun + 5);
    kept.read(2, 0, all);
    kept.read(2, SampleLight::kRun, some);
    for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i], all[SampleLight::kRun + i]);
}

TEST(SampleLight, keeps_darkness_dark) {
    const SampleLight kept(std::vector<float>(kParts * kNumbers, 0.0f), kParts);
    std::vector<double> found(kNumbers, 1.0);
    kept.read(3, 0, found);
    for (const double number : found) EXPECT_EQ(number, 0.0);
}

}  // namespace
}  // namespace daylit
