#pragma once
// Draws an index with probability proportional to its weight in constant time (Walker 1977, built as Vose 1991).
#include <cstdint>
#include <span>
#include <vector>

namespace daylit {

class AliasTable {
  public:
    AliasTable() = default;
    /// Weights are finite and not negative; when all are zero the table is empty.
    explicit AliasTable(std::span<const double> weights);

    bool empty() const { return slots_.empty(); }
    /// u uniform in [0,1).
    std::uint32_t sample(double u) const;
    /// Chance of index i; 0 when empty.
    float probability(std::uint32_t i) const { return empty() ? 0.0f : probabilities_[i]; }

  private:
    struct Slot {
        float keep = 1.0f;
        std::uint32_t other = 0;
    };
    std::vector<Slot> slots_;
    std::vector<float> probabilities_;
};

}  // namespace daylit
