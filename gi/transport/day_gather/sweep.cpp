#include "gi/transport/day_gather/sweep.h"

#include <cstdio>

namespace daylit {
namespace {

std::string named(const char* axis, const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return std::string(axis) + text;
}

}  // namespace

std::vector<SweepPoint> day_gather_sweep(const BakeSettings& base) {
    std::vector<SweepPoint> sweep;
    constexpr double kFactors[] = {0.25, 0.5, 2.0};
    for (const double factor : kFactors) {
        SweepPoint& point = sweep.emplace_back(SweepPoint{"rays", named("rays", " x %g", factor), base});
        point.settings.tuning.rays *= factor;
    }
    for (const double factor : kFactors) {
        SweepPoint& point = sweep.emplace_back(SweepPoint{"texels", named("texels", " x %g", factor), base});
        point.settings.tuning.texels *= factor;
    }
    for (const double factor : {3.0, 0.5}) {
        SweepPoint& point = sweep.emplace_back(SweepPoint{"error", named("error", " %g", factor * base.error), base});
        point.settings.error *= factor;
    }
    return sweep;
}

}  // namespace daylit
