#pragma once
// What a piece of work cost this process.
#include <functional>

namespace daylit {

struct Spent {
    double seconds = 0.0;            // wall
    double processor_seconds = 0.0;  // user and system, all threads
    double peak_bytes = 0.0;         // most resident memory less that before; 0: the system does not say
};

/// Runs `work` and says what it cost. Memory by Linux' high-water mark, which is set back before
/// (/proc/self/clear_refs).
Spent measure(const std::function<void()>& work);

/// Processor time of the calling thread so far, seconds: what other work on the machine does not change.
double thread_seconds();

}  // namespace daylit
