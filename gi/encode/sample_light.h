#pragma once
// A sample's numbers at half the bytes of floats, for the many samples that wait until records are fitted to them.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace daylit {

/// Parts of equally many numbers, kept as 16-bit whole numbers of steps: each run of kRun numbers of a part has a step
/// of its own, so that rounding errs by at most 2e-5 of the run's largest number.
class SampleLight {
  public:
    static constexpr std::size_t kRun = 64;

    SampleLight() = default;
    /// light   [part][number]; finite, as many numbers in every part
    SampleLight(std::span<const float> light, std::size_t parts);

    /// Numbers first, first + 1, ... of a part, as many as `to` has; first is a multiple of kRun.
    void read(std::size_t part, std::size_t first, std::span<double> to) const;

  private:
    std::size_t numbers_ = 0;  // of a part
    std::vector<std::int16_t> values_;
    std::vector<float> steps_;  // [part][run]
};

}  // namespace daylit
