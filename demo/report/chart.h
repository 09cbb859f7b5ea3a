#pragma once
// Scatter charts on logarithmic axes as SVG text, with the Pareto front marked.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "demo/report/result.h"

namespace daylit {

struct ChartPoint {
    double x = 0.0, y = 0.0;
    std::string label;
};

/// Indices of the points that no other point beats, by rising x: a point is beaten when another is at most as large in
/// both coordinates and smaller in one. Of equal points the first counts.
std::vector<std::size_t> pareto_front(std::span<const ChartPoint> points);

/// A logarithmic axis from values to pixels.
struct LogScale {
    double low = 1.0, high = 10.0;  // values at its ends, positive
    double from = 0.0, to = 100.0;  // pixels there
    double operator()(double value) const;
    /// Round values, ascending, within the ends: a few of each decade where there is room, else every few decades.
    std::vector<double> ticks() const;
};
/// Holds all positive finite values with a little room on both sides, at least a factor of two wide.
LogScale scale_for(std::span<const double> values, double from, double to);

struct ChartSeries {
    std::string name;
    std::vector<ChartPoint> points;
    bool competes = true;  // takes part in the Pareto front; else a line to compare with
};

struct ScatterChart {
    std::string title, x_label, y_label;
    Unit x_unit = Unit::Seconds, y_unit = Unit::Share;
    std::vector<ChartSeries> series;
    std::optional<double> floor;  // of y: below it the reference cannot tell
    std::string floor_label;
};

inline constexpr std::size_t kSeriesLooks = 10;  // s0, s1 ... of the page's style; further series begin again

/// An <svg> element that is well-formed XML; looks come from the page's style (classes s0, s1 ... front, grid ...).
/// Points that a logarithmic axis cannot show (zero, not finite) are left out. Empty when nothing is left.
std::string svg(const ScatterChart& chart);

/// Text as it stands in XML.
std::string escaped(const std::string& text);

}  // namespace daylit
