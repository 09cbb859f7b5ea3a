#include "demo/progress.h"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <mutex>

namespace daylit {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

void on_interrupt(int) {
    stop_requested = 1;
    std::signal(SIGINT, SIG_DFL);
}

class Reporter {
  public:
    explicit Reporter(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO) != 0) {}

    void report(double done) {
        const std::lock_guard lock(mutex_);
        const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        if (finished_ || (done < 1.0 && seconds < next_)) return;
        next_ = seconds + (terminal_ ? 0.2 : 10.0);
        finished_ = done >= 1.0;
        terminal_ ? bar(done, seconds) : line(done, seconds);
    }

  private:
    using Clock = std::chrono::steady_clock;

    void bar(double done, double seconds) const {
        constexpr int kWidth = 30;
        std::string cells(kWidth, '.');
        for (int i = 0; i < int(done * kWidth) && i < kWidth; ++i) cells[std::size_t(i)] = '#';
        std::fprintf(stderr, "\r%-24s [%s] %3d %%  ", what_.c_str(), cells.c_str(), int(done * 100));
        if (finished_) {
            std::fprintf(stderr, "%.1f s          \n", seconds);
        } else if (done > 0.01) {
            std::fprintf(stderr, "%.0f s left   ", seconds / done - seconds);
        }
        std::fflush(stderr);
    }

    void line(double done, double seconds) const {
        if (finished_) {
            std::fprintf(stderr, "%s: done in %.1f s\n", what_.c_str(), seconds);
        } else if (done > 0.01) {
            std::fprintf(stderr, "%s: %d %%, %.0f s left\n", what_.c_str(), int(done * 100), seconds / done - seconds);
        }
    }

    std::string what_;
    bool terminal_, finished_ = false;
    double next_ = 0.5;
    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
};

}  // namespace

Progress make_progress(const std::string& what) {
    static const bool installed = std::signal(SIGINT, on_interrupt) != SIG_ERR;
    (void)installed;
    return [reporter = std::make_shared<Reporter>(what)](double done) {
        reporter->report(done);
        return !interrupted();
    };
}

bool interrupted() {
    return stop_requested != 0;
}

}  // namespace daylit
