#include "demo/report/spent.h"

#include <malloc.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <string>

namespace daylit {
namespace {

bool reset_peak() {
    malloc_trim(0);  // what earlier work has freed is not this work's
    std::ofstream clear("/proc/self/clear_refs");
    clear << "5" << std::flush;
    return bool(clear);
}

/// A line of /proc/self/status in bytes, 0 when it is not there.
double status_bytes(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(name)) return 1024.0 * std::stod(line.substr(name.size()));
    return 0.0;
}

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

}  // namespace

Spent measure(const std::function<void()>& work) {
    Spent spent;
    const bool has_peak = reset_peak();
    const double before = status_bytes("VmRSS:");
    const double processor = processor_seconds();
    const auto start = std::chrono::steady_clock::now();
    work();
    spent.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    spent.processor_seconds = processor_seconds() - processor;
    if (has_peak) spent.peak_bytes = status_bytes("VmHWM:") - before;
    return spent;
}

double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace daylit
