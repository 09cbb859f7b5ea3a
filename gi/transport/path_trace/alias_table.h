#pragma once
// Draws an index with probability proportional to its weight in constant time (Walker 1977, built as Vose 1991).
#include <cstdint>
#include <span>
#include <vector>

namespace daylit {

class AliasTable {
  public:
    AliasTable() = default;
    /// Fewer than 2^32 weights, finite and not negative; when all are zero the table is empty.
    explicit AliasTable(std::span<const double> weights);

    bool empty() const { return slots_.empty(); }
    struct Draw {
        std::uint32_t index;
        float probability;  // of this index
    };
    /// bits   64 uniform random bits: the high half chooses a slot, the low half which of its two indices.
    Draw sample(std::uint64_t bits) const {
        const auto i = std::uint32_t(((bits >> 32) * slots_.size()) >> 32);
        const Slot& slot = slots_[i];
        if (std::uint32_t(bits) < slot.keep) return {i, slot.probability};
        return {slot.other, slot.other_probability};
    }
    /// Asks for the slot that sample(bits) will look into: large tables lie far away in memory.
    void prefetch(std::uint64_t bits) const {
        __builtin_prefetch(slots_.data() + (((bits >> 32) * slots_.size()) >> 32));
    }
    /// Chance of index i; 0 when empty.
    float probability(std::uint32_t i) const { return empty() ? 0.0f : slots_[i].probability; }

  private:
    /// All that a draw needs lies in one cache line.
    struct Slot {
        std::uint32_t keep = ~0u;  // chance of the slot's own index, in units of 2^-32
        std::uint32_t other = 0;
        float probability = 0.0f, other_probability = 0.0f;
    };
    std::vector<Slot> slots_;
};

}  // namespace daylit
