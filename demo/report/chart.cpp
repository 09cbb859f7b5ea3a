#include "demo/report/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace daylit {
namespace {

constexpr double kWidth = 520, kHeight = 340, kLeft = 64, kRight = 16, kTop = 34, kBottom = 48;

template <typename... Values>
std::string text(const char* format, Values... values) {
    std::array<char, 512> buffer;
    std::snprintf(buffer.data(), buffer.size(), format, values...);
    return buffer.data();
}

bool drawable(const ChartPoint& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && p.x > 0.0 && p.y > 0.0;
}

/// The chart without what cannot be drawn.
ScatterChart only_drawable(ScatterChart chart) {
    for (ChartSeries& series : chart.series)
        std::erase_if(series.points, [](const ChartPoint& p) { return !drawable(p); });
    std::erase_if(chart.series, [](const ChartSeries& series) { return series.points.empty(); });
    return chart;
}

std::string words(const char* look, double x, double y, const std::string& what, const char* more = "") {
    return text("<text class=\"%s\" x=\"%.1f\" y=\"%.1f\"%s>", look, x, y, more) + escaped(what) + "</text>\n";
}

std::string grid(const ScatterChart& chart, const LogScale& x, const LogScale& y) {
    std::string out;
    for (const double tick : x.ticks()) {
        out += text("<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\"/>\n", x(tick), x(tick), kTop,
                    kHeight - kBottom);
        out += words("tick middle", x(tick), kHeight - kBottom + 15, written(tick, chart.x_unit));
    }
    for (const double tick : y.ticks()) {
        out += text("<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\"/>\n", kLeft, kWidth - kRight,
                    y(tick), y(tick));
        out += words("tick end", kLeft - 6, y(tick) + 4, written(tick, chart.y_unit));
    }
    out += words("title", kLeft, 18, chart.title);
    out += words("axis end", kWidth - kRight, kHeight - 12, chart.x_label);
    out += words("axis end", kLeft, kTop - 4, chart.y_label);
    return out;
}

std::string path(const char* look, std::span<const ChartPoint> points, const LogScale& x, const LogScale& y) {
    std::string d;
    for (const ChartPoint& p : points) d += text("%c%.1f %.1f", d.empty() ? 'M' : 'L', x(p.x), y(p.y));
    return "<path class=\"" + std::string(look) + "\" d=\"" + d + "\"/>\n";
}

std::string mark(const ScatterChart& chart, const ChartPoint& p, const std::string& look, const LogScale& x,
                 const LogScale& y) {
    return text("<circle class=\"%s\" cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\">", look.c_str(), x(p.x), y(p.y)) + "<title>" +
           escaped(p.label + ": " + written(p.y, chart.y_unit) + ", " + written(p.x, chart.x_unit)) +
           "</title></circle>\n";
}

/// Places of words that are already written, so that none is written over another.
class Labels {
  public:
    std::string add(const std::string& what, double x, double y) {
        const double width = 6.0 * double(what.size());
        for (const auto& [dx, dy] : {std::pair(8.0, -7.0), {8.0, 14.0}, {-8.0 - width, -7.0}, {-8.0 - width, 14.0}}) {
            const Box box{x + dx, y + dy - 10.0, x + dx + width, y + dy + 2.0};
            if (box.left < kLeft || box.right > kWidth - kRight || box.top < kTop || box.bottom > kHeight - kBottom)
                continue;
            if (std::any_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.meets(box); })) continue;
            taken_.push_back(box);
            return words("label", x + dx, y + dy, what);
        }
        return {};  // its tooltip still says it
    }
    void take(double x, double y) { taken_.push_back({x - 4, y - 4, x + 4, y + 4}); }

  private:
    struct Box {
        double left, top, right, bottom;
        bool meets(const Box& b) const { return left < b.right && b.left < right && top < b.bottom && b.top < bottom; }
    };
    std::vector<Box> taken_;
};

std::string floor_line(const ScatterChart& chart, const LogScale& y) {
    if (!chart.floor || !(*chart.floor > y.low && *chart.floor < y.high)) return {};
    const double at = y(*chart.floor);
    return text("<line class=\"floor\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\"/>\n", kLeft, kWidth - kRight, at,
                at) +
           words("floor-label end", kWidth - kRight, at - 4, chart.floor_label);
}

}  // namespace

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += static_cast<unsigned char>(c) < ' ' && c != '\n' ? ' ' : c;
        }
    }
    return out;
}

std::vector<std::size_t> pareto_front(std::span<const ChartPoint> points) {
    std::vector<std::size_t> order(points.size()), front;
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
    });
    for (const std::size_t i : order)
        if (front.empty() || points[i].y < points[front.back()].y) front.push_back(i);
    return front;
}

double LogScale::operator()(double value) const {
    return from + (to - from) * std::log(value / low) / std::log(high / low);
}

std::vector<double> LogScale::ticks() const {
    const double decades = std::log10(high / low);
    const int step = std::max(1, int(std::ceil(decades / 6.0)));
    // Close ends leave room for more of each decade.
    std::vector<double> digits = {1.0};
    if (decades <= 3.0) digits = {1.0, 2.0, 5.0};
    if (decades <= 0.8) digits = {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0};
    std::vector<double> result;
    for (int decade = int(std::floor(std::log10(low))) - 1; decade <= int(std::ceil(std::log10(high))); ++decade) {
        if (decade % step != 0) continue;
        for (const double digit : digits) {
            const double tick = digit * std::pow(10.0, decade);
            if (tick >= low * (1.0 - 1e-9) && tick <= high * (1.0 + 1e-9)) result.push_back(tick);
        }
    }
    return result;
}

LogScale scale_for(std::span<const double> values, double from, double to) {
    double low = INFINITY, high = 0.0;
    for (const double v : values)
        if (std::isfinite(v) && v > 0.0) low = std::min(low, v), high = std::max(high, v);
    if (high == 0.0) return {1.0, 10.0, from, to};
    const double middle = std::sqrt(low) * std::sqrt(high);
    const double half = std::max(std::sqrt(high / low) * 1.25, std::sqrt(2.0));
    return {middle / half, middle * half, from, to};
}

std::string svg(const ScatterChart& given) {
    const ScatterChart chart = only_drawable(given);
    if (chart.series.empty()) return {};
    std::vector<double> xs, ys;
    std::vector<ChartPoint> competing;
    for (const ChartSeries& series : chart.series)
        for (const ChartPoint& p : series.points) {
            xs.push_back(p.x), ys.push_back(p.y);
            if (series.competes) competing.push_back(p);
        }
    if (chart.floor && !ys.empty() && *chart.floor > 0.1 * *std::min_element(ys.begin(), ys.end()))
        ys.push_back(*chart.floor);
    const LogScale x = scale_for(xs, kLeft, kWidth - kRight), y = scale_for(ys, kHeight - kBottom, kTop);

    std::string out = text("<svg viewBox=\"0 0 %.0f %.0f\" role=\"img\" aria-label=\"", kWidth, kHeight) +
                      escaped(chart.title) + "\" xmlns=\"http://www.w3.org/2000/svg\">\n" + grid(chart, x, y) +
                      floor_line(chart, y);
    std::vector<ChartPoint> front;
    for (const std::size_t i : pareto_front(competing)) front.push_back(competing[i]);
    if (front.size() > 1) out += path("front-line", front, x, y);
    for (std::size_t s = 0; s < chart.series.size(); ++s) {
        const ChartSeries& series = chart.series[s];
        const std::string look = text("s%zu", s % kSeriesLooks);
        std::vector<ChartPoint> sorted = series.points;
        std::stable_sort(sorted.begin(), sorted.end(),
                         [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
        if (sorted.size() > 1) out += path((look + (series.competes ? " line" : " line other")).c_str(), sorted, x, y);
    }
    Labels labels;
    for (const ChartPoint& p : front) labels.take(x(p.x), y(p.y));
    // A point that several series share is marked alike in each.
    const auto on_front = [&](const ChartPoint& p) {
        return std::any_of(front.begin(), front.end(), [&](const ChartPoint& f) { return f.x == p.x && f.y == p.y; });
    };
    for (std::size_t s = 0; s < chart.series.size(); ++s)
        for (const ChartPoint& p : chart.series[s].points) {
            const bool competes = chart.series[s].competes, best = competes && on_front(p);
            out += mark(chart, p,
                        text("s%zu%s", s % kSeriesLooks,
                             best       ? " best"
                             : competes ? " beaten"
                                        : " other"),
                        x, y);
        }
    for (const ChartPoint& p : front) out += labels.add(p.label, x(p.x), y(p.y));
    return out + "</svg>\n";
}

}  // namespace daylit
