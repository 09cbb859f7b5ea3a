#include "demo/report/chosen.h"

#include <algorithm>

#include "demo/parse.h"
#include "engine/base/error.h"

namespace daylit {
namespace {

Chosen everything(bool quick, const BakeSettings& base) {
    BakeSettings day = base, few = base;
    day.from_hour = 0.0, day.to_hour = 24.0;
    constexpr double kQuickEvery = 1.0 / 3.0, kQuickCells = 0.25;  // hours; of the plan's
    if (quick) day.every_hours = std::min(day.every_hours, kQuickEvery), few.tuning.cells *= kQuickCells;
    return {report_methods(base), report_studies(few, day)};
}

/// The first point of each axis: sweeps begin with what costs least.
std::vector<SweepPoint> one_an_axis(const std::vector<SweepPoint>& sweep) {
    std::vector<SweepPoint> result;
    for (const SweepPoint& point : sweep)
        if (result.empty() || point.axis != result.back().axis) result.push_back(point);
    return result;
}

}  // namespace

bool Chosen::wants(bool in_space) const {
    const auto judged_there = [&](const auto& m) { return m.in_space == in_space; };
    return std::any_of(methods.begin(), methods.end(), judged_there) ||
           std::any_of(studies.begin(), studies.end(), judged_there);
}

Chosen chosen(const std::string& names, bool quick, const BakeSettings& base) {
    Chosen all = everything(quick, base);
    for (ReportMethod& m : all.methods)
        if (quick) m.sweep = one_an_axis(m.sweep);
    if (names == "all") return all;
    Chosen result;
    std::string known;
    for (const ReportMethod& m : all.methods) known += ", " + m.name;
    for (const ReportStudy& s : all.studies) known += ", " + s.name;
    for (const std::string& name : split(names, ',')) {
        const auto named = [&](const auto& m) { return m.name == name; };
        const auto method = std::find_if(all.methods.begin(), all.methods.end(), named);
        const auto study = std::find_if(all.studies.begin(), all.studies.end(), named);
        if (method != all.methods.end())
            result.methods.push_back(*method);
        else if (study != all.studies.end())
            result.studies.push_back(*study);
        else
            throw UsageError("--methods", "'" + name + "' is not one of all" + known);
    }
    return result;
}

}  // namespace daylit
