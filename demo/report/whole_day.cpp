#include "demo/report/whole_day.h"

#include <cmath>

#include "demo/lightmap_points.h"
#include "demo/parse.h"
#include "demo/report/spent.h"
#include "engine/base/error.h"
#include "gi/bake_plan.h"

namespace daylit {
namespace {

constexpr int kDayHours = 288;  // every 5 minutes

struct Bake {
    std::string name;
    BakeSettings settings;
    bool judged = true;
};

/// The truth of the hour nearest to noon alone.
PointTruth at_noon(const PointTruth& truth) {
    const auto nearest = std::min_element(truth.hours.begin(), truth.hours.end(),
                                          [](double a, double b) { return std::abs(a - 12.0) < std::abs(b - 12.0); });
    const auto k = nearest - truth.hours.begin();
    return {truth.points, {*nearest}, {truth.light[std::size_t(k)]}, truth.standard_error};
}

std::vector<Bake> bakes_of(const BakeSettings& base, double hour) {
    Bake day{"whole day, all bounces", base};
    day.settings.parts = {"lightmap"};
    Bake one{"one hour, one bounce", day.settings, false}, all{"one hour, all bounces", day.settings};
    one.settings.from_hour = one.settings.to_hour = all.settings.from_hour = all.settings.to_hour = hour;
    one.settings.bounces = 1;
    return {day, one, all};
}

RunResult run_bake(const Bake& bake_of, const PointTruth& truth, const Judges& judges, const Progress& progress) {
    RunResult run{.method = "whole-day", .axis = bake_of.name, .name = bake_of.name};
    const Scene& scene = judges.level.loaded.scene;
    Baked baked;
    const Spent spent = measure([&] { baked = bake(scene, bake_of.settings, progress); });
    if (!baked.lightmap) throw Error("not compared", "the scene has no static surfaces to hold a lightmap");
    run.values["bake_seconds"] = spent.seconds, run.values["bake_processor_seconds"] = spent.processor_seconds;
    if (spent.peak_bytes > 0.0) run.values["peak_bytes"] = spent.peak_bytes;
    const LightModel& light = judges.level.light;
    if (bake_of.judged) {
        const double hour = truth.hours.front();
        const LightScales scales = light.scales(hour, light.settings().clouds);
        run.values.merge(judge({lightmap_irradiance(*baked.lightmap, scene, scales, hour, truth.points)}, truth));
    }
    return run;
}

}  // namespace

StudyResult compare_whole_day(const BakeSettings& base, const Judges& judges, const Progress& progress) {
    const PointTruth noon = at_noon(judges.surface);
    const std::vector<Bake> bakes = bakes_of(base, noon.hours.front());
    StudyResult result;
    for (const Bake& b : bakes) {
        const double begin = double(result.runs.size()) / double(bakes.size());
        result.runs.push_back(run_bake(
            b, noon, judges, [&](double done) { return !progress || progress(begin + done / double(bakes.size())); }));
    }
    const auto spent = [&](std::size_t run, const char* key) { return *result.runs[run].value(key); };
    const std::size_t hours = baked_hours(judges.level.light, base.from_hour, base.to_hour, base.every_hours).size();
    for (const auto& [key, what] : {std::pair("bake_seconds", "wall"), {"bake_processor_seconds", "processor"}}) {
        const double day = spent(0, key), one = spent(1, key), all = spent(2, key);
        result.findings.push_back(
            {std::string("day_over_hour_") + what, day / one,
             "The whole day, " + std::to_string(hours) + " hours that are not deep night, with all bounces takes " +
                 written(day / one, Unit::Number) + " times the " + what + " time of " +
                 clock_text(noon.hours.front()) + " with one bounce, the same rays; " + std::to_string(kDayHours) +
                 " bakes of an hour each would take " + written(kDayHours * one, Unit::Seconds) + " with one bounce, " +
                 written(kDayHours * all, Unit::Seconds) + " with all (" +
                 written(kDayHours * all / day, Unit::Number) + " times the whole day's)"});
    }
    return result;
}

}  // namespace daylit
