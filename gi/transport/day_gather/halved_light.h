#pragma once
// All light that leaves receivers and sky bins, at half the bytes, to be gathered from again.
#include <cstdint>
#include <vector>

#include "gi/transport/day_gather/bfloat.h"
#include "gi/transport/day_gather/day_solution.h"

namespace daylit {

class HalvedLight {
  public:
    explicit HalvedLight(const DaySolution& day);

    /// source, here and below: an index into DaySolution::leaving
    void prefetch(std::size_t source) const {
        for (std::size_t line = 0; line < width_; line += 32) __builtin_prefetch(row(source) + line);
    }
    void add(std::size_t source, float* sum) const {
        const std::uint16_t* from = row(source);
        for (std::size_t i = 0; i < width_; ++i) sum[i] += from_bfloat(from[i]);
    }
    /// The row times both weights.
    void add(std::size_t source, const Vec2& weights, float* u, float* v) const {
        const std::uint16_t* from = row(source);
        for (std::size_t i = 0; i < width_; ++i) {
            const float value = from_bfloat(from[i]);
            u[i] += weights.x * value, v[i] += weights.y * value;
        }
    }

    static constexpr std::size_t kMostNumbers = 3 * kMostComponents;  // of a row
    static constexpr std::size_t kAhead = 6;             // rows to fetch ahead of their use

  private:
    const std::uint16_t* row(std::size_t source) const { return light_.data() + source * width_; }

    std::size_t width_;  // numbers of a row: 3 * components
    std::vector<std::uint16_t> light_;
};

}  // namespace daylit
