#include "gi/transport/day_gather/halved_light.h"

#include <algorithm>

#include "gi/parallel.h"

namespace daylit {

HalvedLight::HalvedLight(const DaySolution& day) : width_(3 * day.basis.components), light_(3 * day.leaving.size()) {
    const StageProgress silent{Progress{}};
    constexpr std::size_t kBlock = 1 << 16;
    for_each_parallel((day.leaving.size() + kBlock - 1) / kBlock, silent, [&](std::size_t block) {
        for (std::size_t i = block * kBlock; i < std::min(day.leaving.size(), (block + 1) * kBlock); ++i)
            for (int c = 0; c < 3; ++c) light_[3 * i + std::size_t(c)] = to_bfloat(day.leaving[i][c]);
    });
}

}  // namespace daylit
