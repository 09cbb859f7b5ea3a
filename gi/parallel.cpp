#include "gi/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace daylit {

void StageProgress::at(double done_of_stage) const {
    if (report && !report(begin + (end - begin) * done_of_stage)) throw Interrupted{};
}

void for_each_parallel(std::size_t count, const StageProgress& progress, const std::function<void(std::size_t)>& work,
                       std::size_t least_round) {
    // Enough rounds to answer Ctrl-C soon, each long enough to keep all threads busy.
    const std::size_t round = std::max(count / 50, least_round);
    for (std::size_t first = 0; first < count; first += round) {
        progress.at(double(first) / double(count));
        const std::size_t last = std::min(first + round, count);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) work(i);
        });
    }
    progress.at(1.0);
}

}  // namespace daylit
