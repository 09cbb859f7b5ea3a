#include "demo/report/equal_error.h"

#include <cmath>

namespace daylit {
namespace {

/// By rising cost and falling error; what a logarithm cannot take is left out.
std::vector<ChartPoint> front_of(std::span<const ChartPoint> points) {
    std::vector<ChartPoint> usable, front;
    for (const ChartPoint& p : points)
        if (p.x > 0.0 && p.y > 0.0 && std::isfinite(p.x) && std::isfinite(p.y)) usable.push_back(p);
    for (const std::size_t i : pareto_front(usable)) front.push_back(usable[i]);
    return front;
}

std::optional<double> cost_of(const std::vector<ChartPoint>& front, double error) {
    for (std::size_t i = 0; i + 1 < front.size(); ++i) {
        const ChartPoint &a = front[i], &b = front[i + 1];
        if (error > a.y || error < b.y) continue;
        const double share = std::log(error / a.y) / std::log(b.y / a.y);
        return a.x * std::pow(b.x / a.x, share);
    }
    return std::nullopt;
}

}  // namespace

std::optional<CostRatio> cost_at_equal_error(std::span<const ChartPoint> ours, std::span<const ChartPoint> other) {
    const std::vector<ChartPoint> mine = front_of(ours), theirs = front_of(other);
    if (mine.empty() || theirs.empty()) return std::nullopt;
    double logarithms = 0.0;
    int count = 0;
    for (const ChartPoint& p : mine)
        if (const auto cost = cost_of(theirs, p.y)) logarithms += std::log(*cost / p.x), ++count;
    if (count > 0) return CostRatio{std::exp(logarithms / count), false, count, int(mine.size())};
    if (mine.front().y > theirs.back().y) return std::nullopt;
    return CostRatio{theirs.back().x / mine.front().x, true, 0, int(mine.size())};
}

std::vector<ChartPoint> bytes_and_error(const std::vector<RunResult>& runs, const std::string& axis,
                                        const char* error) {
    std::vector<ChartPoint> points;
    for (const RunResult& run : runs)
        if (run.axis == axis) points.push_back({*run.value("file_bytes"), *run.value(error), run.name});
    return points;
}

}  // namespace daylit
