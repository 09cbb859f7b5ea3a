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
};

/// Calls work(i) for i in [0, count), each once, in any order and from several threads: work(i) may write only what
/// belongs to i, so that results do not depend on the threads.
void for_each_parallel(std::size_t count, const StageProgress& progress, const std::function<void(std::size_t)>& work);

}  // namespace daylit
