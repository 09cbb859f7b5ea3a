#pragma once
// Loops over receivers on all cores, with progress and a way to stop.
#include <cstddef>
#include <functional>

#include "engine/base/progress.h"

namespace daylit {

/// A stage of longer work: its share of the whole, from `begin` to `end`.
struct StageProgress {
    const Progress& report;
    double begin = 0.0, end = 1.0;
    /// throws Interrupted when the work is to stop.
    void at(double done_of_stage) const;
    /// A stage of this stage, from `first` to `last` of it.
    StageProgress part(double first, double last) const {
        return {report, begin + (end - begin) * first, begin + (end - begin) * last};
    }
};

/// Calls work(i) for i in [0, count), each once, in any order and from several threads: work(i) may write only what
/// belongs to i, so that results do not depend on the threads.
/// least_round   at least so many between two looks at `progress`: enough to keep all threads busy
void for_each_parallel(std::size_t count, const StageProgress& progress, const std::function<void(std::size_t)>& work,
                       std::size_t least_round = 2048);

}  // namespace daylit
