#include "demo/report/sweep_runner.h"

#include <algorithm>
#include <cmath>

#include "demo/parse.h"
#include "demo/report/spent.h"
#include "engine/base/error.h"
#include "gi/bake.h"

namespace daylit {
namespace {

constexpr std::uint64_t kTracedSeed = 0x747261636564;

std::string note_of(const Baked& baked, const std::string& part) {
    for (const PlanItem& item : baked.plan)
        if (item.part == part) return item.why;
    return "not in the bake's plan";
}

Instant instant(const LightModel& light, double hour) {
    return {hour, light.scales(hour, light.settings().clouds)};
}

void judge_points(const ReportMethod& method, const Baked& baked, const Judges& judges, RunResult& run) {
    const PointTruth& truth = method.in_space ? judges.space : judges.surface;
    LightAtPoints light;
    for (const double hour : truth.hours)
        light.push_back(
            method.irradiance(baked, judges.level.loaded.scene, instant(judges.level.light, hour), truth.points));
    run.values.merge(judge(light, truth));
    run.values["look_up_seconds"] =
        method.look_up(baked, instant(judges.level.light, truth.hours.front()), truth.points);
    run.values["answers"] = method.answers(baked);
}

/// Means and the worst over the pictures of a run.
void sum_up(RunResult& run) {
    if (run.pictures.empty()) return;
    double flip = 0.0, worst = 0.0, yee = 0.0;
    for (const PictureResult& p : run.pictures) {
        flip += p.values.at("flip_mean"), yee += p.values.at("yee_share");
        worst = std::max(worst, p.values.at("flip_mean"));
    }
    const double count = double(run.pictures.size());
    run.values["flip_mean"] = flip / count, run.values["flip_worst"] = worst, run.values["yee_share"] = yee / count;
}

Image heat(const std::vector<float>& flip, int width, int height) {
    Image image(width, height);
    std::transform(flip.begin(), flip.end(), image.pixels.begin(), heat_color);
    return image;
}

void judge_pictures(const ReportMethod& method, const Baked& baked, const Judges& judges,
                    const std::filesystem::path& folder, bool keep, RunResult& run) {
    std::vector<ViewAt> views;
    for (const PictureTruth& truth : judges.pictures) views.push_back(truth.at);
    Frames frames = judges.frames->draw(judges.level, baked, views, judges.size, true);
    run.values.merge(frames.values);
    for (std::size_t i = 0; i < views.size(); ++i) {
        JudgedPicture judged = judge(frames.radiance[i], judges.pictures[i]);
        if (keep) {
            const std::string name = file_name(method.name + "-" + views[i].view + "-" + clock_text(views[i].hour));
            judged.result.file = "pictures/" + name + ".png",
            judged.result.difference = "pictures/" + name + "-flip.png";
            write_image(folder / judged.result.file, judged.shown);
            write_image(folder / judged.result.difference, heat(judged.flip, judged.shown.width, judged.shown.height));
        }
        run.pictures.push_back(std::move(judged.result));
    }
    sum_up(run);
}

}  // namespace

RunResult run_point(const ReportMethod& method, const SweepPoint& point, const Judges& judges,
                    const std::filesystem::path& folder, bool keep_pictures, const Progress& progress) {
    RunResult run{.method = method.name, .axis = point.axis, .name = point.name};
    try {
        Baked baked;
        const Spent spent = measure([&] { baked = bake(judges.level.loaded.scene, point.settings, progress); });
        run.note = note_of(baked, method.part);
        if (!method.present(baked)) throw Error("not baked", run.note);
        run.values["bake_seconds"] = spent.seconds, run.values["bake_processor_seconds"] = spent.processor_seconds;
        if (spent.peak_bytes > 0.0) run.values["peak_bytes"] = spent.peak_bytes;

        // Judged is what the file gives back, not what was in memory before.
        const std::filesystem::path file = folder / "runs" / (file_name(method.name + "-" + point.name) + ".daylit");
        write_baked(file, baked);
        baked = read_baked(file);
        run.values["file_bytes"] = double(std::filesystem::file_size(file));
        std::filesystem::remove(file);

        judge_points(method, baked, judges, run);
        if (method.in_pictures && judges.frames && !judges.pictures.empty())
            judge_pictures(method, baked, judges, folder, keep_pictures, run);
    } catch (const Error& error) {
        run.values.clear(), run.pictures.clear();
        run.failure = error.what();
    }
    return run;
}

RunResult run_traced_points(const std::string& axis, const PointTruth& truth, int spp, const LevelAtRest& level,
                            const Progress& progress) {
    RunResult run{.method = "path tracer", .axis = axis, .name = std::to_string(spp) + (spp == 1 ? " path" : " paths")};
    const std::vector<Lighting> lighting = level.at(truth.hours);
    LightAtPoints light;
    const Spent spent = measure([&] { light = trace_once(level, truth, lighting, spp, kTracedSeed, progress); });
    run.values = judge(light, truth);
    run.values["look_up_seconds"] = spent.seconds / double(truth.points.size() * truth.hours.size());
    run.values["answers"] = double(truth.points.size() * truth.hours.size());
    return run;
}

RunResult run_traced_pictures(int spp, const Judges& judges, const Progress& progress) {
    RunResult run{
        .method = "path tracer", .axis = "pictures", .name = std::to_string(spp) + (spp == 1 ? " path" : " paths")};
    double seconds = 0.0, processor = 0.0;
    for (const PictureTruth& truth : judges.pictures) {
        const Lighting lighting = judges.level.light.at(truth.at.hour);
        PathTraceImage picture;
        const Spent spent = measure([&] {
            picture = path_trace(judges.level.rays, lighting, judges.level.lamps, truth.at.camera, judges.size.width,
                                 judges.size.height, {.spp = spp, .seed = kTracedSeed}, {});
        });
        seconds += spent.seconds, processor += spent.processor_seconds;
        run.pictures.push_back(judge(picture.radiance, truth).result);
        if (progress && !progress(double(run.pictures.size()) / double(judges.pictures.size()))) throw Interrupted();
    }
    run.values["frame_seconds"] = seconds / double(judges.pictures.size());
    run.values["frame_processor_seconds"] = processor / double(judges.pictures.size());
    sum_up(run);
    return run;
}

void compare_with_traced(std::vector<RunResult>& runs, const std::vector<RunResult>& traced) {
    if (traced.empty()) return;
    const RunResult& most = traced.back();
    const auto error = most.value("nrmse"), each = most.value("look_up_seconds");
    if (!error || !each || *error == 0.0) return;
    for (RunResult& run : runs) {
        const auto own = run.value("nrmse"), answers = run.value("answers");
        if (own && answers && *own > 0.0)
            run.values["traced_alike_seconds"] = *each * *answers * (*error / *own) * (*error / *own);
    }
}

}  // namespace daylit
