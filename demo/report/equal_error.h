#pragma once
// What the same error costs two ways.
#include <optional>
#include <span>

#include "demo/report/chart.h"

namespace daylit {

struct CostRatio {
    double ratio = 0.0;       // the other way's cost over ours
    bool at_least = false;    // no error is reached by both: the other's best is still worse than our cheapest
    int reached = 0, of = 0;  // of our points that count, how many the other way is as good as
};

/// Points are cost (x) and error (y), both above zero; only each way's Pareto front counts. The mean (geometric) over
/// those of our points whose error the other way reaches; its cost there is read off its front, straight between points
/// in logarithms. None when the other way is better than ours everywhere or there is nothing to compare.
std::optional<CostRatio> cost_at_equal_error(std::span<const ChartPoint> ours, std::span<const ChartPoint> other);

/// Of the runs of an axis: bytes of the file, and the value of this name.
std::vector<ChartPoint> bytes_and_error(const std::vector<RunResult>& runs, const std::string& axis, const char* error);

}  // namespace daylit
