#include "gi/transport/path_trace/alias_table.h"

namespace daylit {

AliasTable::AliasTable(std::span<const double> weights) {
    double sum = 0.0;
    for (const double w : weights) sum += w;
    if (!(sum > 0.0)) return;

    const std::size_t n = weights.size();
    slots_.resize(n);
    std::vector<double> scaled(n);
    std::vector<std::uint32_t> small, large;
    for (std::uint32_t i = 0; i < n; ++i) {
        slots_[i].probability = float(weights[i] / sum);
        scaled[i] = weights[i] / sum * double(n);
        (scaled[i] < 1.0 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t poor = small.back(), rich = large.back();
        small.pop_back();
        slots_[poor].keep = std::uint32_t(scaled[poor] * 0x1p32);
        slots_[poor].other = rich;
        scaled[rich] -= 1.0 - scaled[poor];
        if (scaled[rich] < 1.0) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // What rounding left over keeps its own index, and with it every chance of being drawn.
    for (const auto* rest : {&small, &large})
        for (const std::uint32_t i : *rest) slots_[i].other = i;
    for (Slot& slot : slots_) slot.other_probability = slots_[slot.other].probability;
}

}  // namespace daylit
