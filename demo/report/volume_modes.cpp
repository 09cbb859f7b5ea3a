#include "demo/report/volume_modes.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cstdio>
#include <map>

#include "demo/report/equal_error.h"
#include "demo/report/spent.h"
#include "demo/sample_points.h"
#include "engine/base/error.h"
#include "gi/encode/encode_volume.h"
#include "gi/encode/sweep.h"
#include "gi/encode/volume_records.h"
#include "gi/solved_day.h"

namespace daylit {
namespace {

constexpr int kGatherRays = 4096;  // at a place
// Places that are judged by the gather, for each by the reference, which costs a hundred times as much: of 400 a single
// one, millimetres above a patch of sun, is a quarter of the mean square error.
constexpr int kGatherPlaces = 5;
constexpr int kMoreRays = 8;       // of a sample, times the plan's, so that noise does not hide what blends differ in
constexpr int kModeLookUps = 50000;

LightScales scales_at(const LightModel& light, double hour) {
    return light.scales(hour, light.settings().clouds);
}

/// What the gather says at places, by rays that are this run's own.
LightAtPoints gather_at(const VolumeEncoder& encoder, const LightBasis& basis, const LightModel& light,
                        const PointTruth& at, std::size_t run, int rays) {
    LightAtPoints found(at.hours.size(), std::vector<Rgb>(at.points.size()));
    std::vector<std::vector<Rgb>> weights;
    for (const double hour : at.hours) weights.push_back(basis.weights(scales_at(light, hour), hour));
    const std::size_t components = std::size_t(basis.components);
    tbb::parallel_for(std::size_t(0), at.points.size(), [&](std::size_t p) {
        const std::vector<float> gathered = encoder.gathered(at.points[p].position, run * at.points.size() + p, rays);
        for (std::size_t h = 0; h < at.hours.size(); ++h) {
            glsl::VolumeSh sh{};
            for (int i = 0; i < glsl::kVolumeNumbers; ++i)
                for (std::size_t r = 0; r < components; ++r)
                    sh.c[i / 3][i % 3] += weights[h][r][i % 3] * gathered[std::size_t(i) * components + r];
            found[h][p] = glsl::volume_irradiance(sh, at.points[p].normal, 1.0f);
        }
    });
    return found;
}

/// Half of the rays apart from the other half, so that they tell its standard error.
PointTruth gather_truth(const VolumeEncoder& encoder, const LightBasis& basis, const Judges& judges,
                        std::uint64_t seed) {
    const int places = kGatherPlaces * int(judges.space.points.size());
    PointTruth truth{sample_space(judges.level.rays, judges.level.pose, places, seed), judges.space.hours, {}, 0.0};
    truth.light = gather_at(encoder, basis, judges.level.light, truth, 0, kGatherRays / 2);
    const LightAtPoints other = gather_at(encoder, basis, judges.level.light, truth, 1, kGatherRays / 2);
    truth.standard_error = 0.5 * judge(other, truth).at("nrmse");
    for (std::size_t h = 0; h < other.size(); ++h)
        for (std::size_t p = 0; p < other[h].size(); ++p) truth.light[h][p] = 0.5f * (truth.light[h][p] + other[h][p]);
    return truth;
}

double seconds_of_a_look_up(const VolumeModeLight& light, const std::vector<SurfaceSample>& points) {
    Rgb sum(0.0f);
    const double start = thread_seconds();
    for (std::size_t i = 0; i < kModeLookUps; ++i) {
        const SurfaceSample& p = points[i % points.size()];
        sum += light.irradiance(p.position, p.normal);
    }
    const double seconds = thread_seconds() - start;
    return std::isfinite(sum.x) ? seconds / kModeLookUps : 0.0;
}

std::vector<Rgb> look_up(const VolumeModeLight& light, const std::vector<SurfaceSample>& points) {
    std::vector<Rgb> found;
    for (const SurfaceSample& p : points) found.push_back(light.irradiance(p.position, p.normal));
    return found;
}

RunResult judge_mode(const VolumeModePoint& point, const IrradianceVolume& volume, float steps,
                     const PointTruth& reference, const PointTruth& gathered, const LightModel& model) {
    char name[96];
    std::snprintf(name, sizeof name, "%s, %zu cells%s", point.axis.c_str(), volume.tree.cells.size(),
                  steps > 1.0f ? ", coarse steps" : "");
    RunResult run{.method = "volume-modes",
                  .axis = point.axis,
                  .name = name,
                  .note = std::to_string(volume.tree.samples) + " records"};
    LightAtPoints found, beside_gather;
    for (const double hour : reference.hours) {
        const VolumeModeLight light(volume, point.mode, volume.basis.weights(scales_at(model, hour), hour));
        found.push_back(look_up(light, reference.points));
        beside_gather.push_back(look_up(light, gathered.points));
        if (hour == reference.hours.back())
            run.values["look_up_seconds"] = seconds_of_a_look_up(light, reference.points);
    }
    run.values.merge(judge(found, reference));
    run.values["gather_nrmse"] = judge(beside_gather, gathered).at("nrmse");
    double p95 = 0.0;
    for (std::size_t h = 0; h < found.size(); ++h) p95 += differences(beside_gather[h], gathered.light[h]).p95;
    run.values["gather_p95"] = p95 / double(found.size());
    run.values["file_bytes"] = stored_bytes(volume, point.mode);
    return run;
}

/// What another way takes in bytes at equal error, and how far each goes.
Finding equal_bytes(const std::vector<RunResult>& runs, const std::string& axis, const char* error,
                    const std::string& against, const CostRatio& ratio) {
    const std::string ours = runs.front().axis;
    const auto best = [&](const std::string& of) {
        const std::vector<ChartPoint> points = bytes_and_error(runs, of, error);
        return *std::min_element(points.begin(), points.end(),
                                 [](const ChartPoint& a, const ChartPoint& b) { return a.y < b.y; });
    };
    const auto said = [](const ChartPoint& p) {
        return written(p.y, Unit::Share) + " with " + written(p.x, Unit::Bytes);
    };
    const std::string bests = "; its best is " + said(best(axis)) + ", that of " + ours + " " + said(best(ours));
    if (ratio.at_least)
        return {"", ratio.ratio, "No size of " + axis + " reaches the " + against + " of any size of " + ours + bests};
    const std::string where = ratio.reached == ratio.of
                                  ? ""
                                  : " where it reaches the error, at " + std::to_string(ratio.reached) + " of " +
                                        std::to_string(ratio.of) + " sizes";
    return {"", ratio.ratio,
            "At an equal " + against + ", " + axis + " takes " + written(ratio.ratio, Unit::Number) +
                " times the bytes of " + ours + where + bests};
}

std::vector<Finding> findings(const std::vector<RunResult>& runs, double gather_error) {
    struct Error {
        const char *measure, *said, *key;
    };
    std::vector<Finding> all;
    for (const Error& error : {Error{"gather_nrmse", "nrmse against the gather", "gather"},
                               Error{"gather_p95", "95th percentile against the gather", "gather_p95"},
                               Error{"nrmse", "nrmse against the reference", "reference"}})
        for (const auto& [axis, key] : {std::pair("uniform grid", "grid"), {"trilinear", "trilinear"}}) {
            const auto ratio = cost_at_equal_error(bytes_and_error(runs, runs.front().axis, error.measure),
                                                   bytes_and_error(runs, axis, error.measure));
            if (!ratio) continue;
            all.push_back(equal_bytes(runs, axis, error.measure, error.said, *ratio));
            all.back().key = std::string(key) + "_over_" + error.key;
        }
    all.push_back({"gather_error", gather_error,
                   "The gather's own standard error is " + written(gather_error, Unit::Share) + " of its mean"});
    return all;
}

/// One volume in each of the steps that are compared.
std::vector<IrradianceVolume> in_steps(const VolumeEncoder& encoder, const VolumeSettings& size) {
    EncodedVolume encoded = encoder.encode(size, StageProgress{Progress{}});
    if (encoded.volume.tree.empty()) throw Error("not compared", "no free space is reached");
    std::vector<IrradianceVolume> all;
    for (const float steps : kVolumeSteps) {
        store_records(encoded.records, steps * size.rounding, encoded.volume);
        all.push_back(encoded.volume);
    }
    return all;
}

}  // namespace

StudyResult compare_volume_modes(const BakeSettings& base, const Judges& judges, const Progress& progress) {
    BakeSettings settings = base;
    settings.parts = {"volume"};
    const BakeInput input(judges.level.loaded.scene, settings);
    const auto part = [&](double from, double to) -> Progress {
        return [&progress, from, to](double done) { return !progress || progress(from + (to - from) * done); };
    };
    const SolvedDay solved(input, part(0.0, 0.3));
    const LightBasis basis = light_basis(solved.day.basis);
    const LeavingLight leaving = solved.leaving();
    VolumeSettings plan = input.plan.volume_settings;
    plan.rays *= kMoreRays;
    const VolumeEncoder encoder(input.scene, solved.reachable, solved.gather, solved.hits, basis, leaving,
                                solved.moments, plan, {.dropped = kVolumeDropped * settings.error}, true);
    const LightModel& light = judges.level.light;
    const PointTruth gathered = gather_truth(encoder, basis, judges, settings.seed);

    StudyResult result;
    const std::vector<VolumeModePoint> modes = volume_modes();
    // Modes that differ in bands share. In each of its steps:
    std::map<std::tuple<VolumeBlend, bool, std::size_t>, std::vector<IrradianceVolume>> made;
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const VolumeScheme& mode = modes[m].mode;
        const std::vector<VolumeSettings> sizes = volume_sizes(mode, plan, encoder.roots());
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const double share = (double(m) + double(i) / double(sizes.size())) / double(modes.size());
            if (!part(0.3, 1.0)(share)) throw Interrupted();
            const auto [volumes, is_new] = made.try_emplace({mode.blend, mode.grid, i});
            if (is_new) volumes->second = in_steps(encoder, sizes[i]);
            for (std::size_t s = 0; s < kVolumeSteps.size(); ++s)
                result.runs.push_back(
                    judge_mode(modes[m], volumes->second[s], kVolumeSteps[s], judges.space, gathered, light));
        }
    }
    result.findings = findings(result.runs, gathered.standard_error);
    return result;
}

}  // namespace daylit
