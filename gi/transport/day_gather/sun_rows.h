#pragma once
// Straight sunlight on receivers over the day. The sun moves along an arc, so a point sees it in a few stretches of
// time: sparse hours are tested and edges are bisected.
#include <cstdint>
#include <span>
#include <vector>

#include "gi/transport/day_gather/day_gather.h"

namespace daylit {

/// Share of a facing plane's sunlight that each receiver gets at each hour, kept from the first lit hour to the last.
class SunRows {
  public:
    /// suns   per hour: none, or the one that moves
    SunRows(const GatherScene& scene, const GatherHits& hits, std::span<const double> hours,
            std::span<const std::vector<Sun>> suns, const GatherSettings& settings, const StageProgress& progress);
    SunRows() = default;

    struct Row {
        std::size_t first = 0;          // hour of values[0]
        std::span<const float> values;  // 0 to 1; empty: the sun never comes here
    };
    Row row(std::size_t receiver) const;
    std::size_t tests() const { return tests_; }  // rays that it took

  private:
    static constexpr std::size_t kChunk = 1024;  // receivers whose values lie in one piece of memory
    struct Place {
        std::uint32_t begin = 0;
        std::uint16_t first = 0, count = 0;
    };
    std::vector<Place> places_;
    std::vector<std::vector<float>> chunks_;
    std::size_t tests_ = 0;
};

}  // namespace daylit
