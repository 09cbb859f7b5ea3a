#pragma once
// The pieces of work that a report is made of, with one line of progress over all of them.
#include <string>

#include "demo/progress.h"
#include "demo/report/finished.h"

namespace daylit {

/// Those that are kept from before count for nothing in the progress.
class Pieces {
  public:
    Pieces(Finished finished, int total)
        : finished_(std::move(finished)), total_(total), report_(make_progress("report")) {}

    /// The kept piece, or a new one by make(progress), kept.
    template <class T, class Make>
    T get(const std::string& name, const Make& make) {
        if (const auto kept = finished_.find(name)) {
            ++kept_;
            return kept->template get<T>();
        }
        const Progress progress = [this](double done) { return report_(share(done)); };
        T piece = make(progress);
        finished_.keep(name, piece);
        ++done_;
        if (!report_(share(0.0))) throw Interrupted();
        return piece;
    }
    const Finished& finished() const { return finished_; }
    int kept() const { return kept_; }
    void end() { report_(1.0); }

  private:
    double share(double done) const {
        return std::min((double(done_) + done) / double(std::max(total_ - kept_, 1)), 0.999);
    }
    Finished finished_;
    int total_, done_ = 0, kept_ = 0;
    Progress report_;
};

}  // namespace daylit
