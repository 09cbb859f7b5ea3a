// daylit report: error against time and memory for each method on a scene, as one page with its numbers and pictures.
#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <thread>

#include "demo/commands.h"
#include "demo/options.h"
#include "demo/parse.h"
#include "demo/report/chosen.h"
#include "demo/report/pieces.h"
#include "demo/sample_points.h"
#include "engine/base/error.h"
#include "engine/base/exposure.h"
#include "engine/base/file.h"
#include "gi/bake_plan.h"

namespace daylit {
namespace {

struct ReportOptions {
    SceneOptions scene;
    ViewOptions view;
    std::string output, methods = "all", hours, picture_hours, every = "5m", quality = "medium";
    std::optional<double> error;
    int points = 500, spp = 4096, picture_spp = 256, threads = 0;
    std::uint64_t seed = 1;
    bool quick = false, json = false;
};

std::vector<double> parse_hours(const char* option, const std::string& text) {
    std::vector<double> hours;
    for (const std::string& part : split(text, ',')) hours.push_back(parse_hour(option, part));
    std::sort(hours.begin(), hours.end());
    hours.erase(std::unique(hours.begin(), hours.end()), hours.end());
    return hours;
}

/// What --quick stands for, where the user has not said otherwise.
void apply_quick(const CLI::App& command, ReportOptions& options) {
    const auto unless_given = [&](const char* name, auto& value, auto quick) {
        if (options.quick && command.get_option(name)->count() == 0) value = quick;
    };
    unless_given("--points", options.points, 60);
    unless_given("--spp", options.spp, 256);
    unless_given("--picture-spp", options.picture_spp, 16);
    unless_given("--size", options.view.size, "160x90");
    if (!options.error) unless_given("--quality", options.quality, "preview");
    unless_given("--every", options.every, "1h");
    if (options.hours.empty()) options.hours = options.quick ? "10,12" : "6,9,12,15,18,21";
    if (options.picture_hours.empty()) options.picture_hours = options.quick ? "12" : "9,12,18";
}

void check_counts(const ReportOptions& options) {
    if (options.points < 1 || options.points > 1000000) throw Error("--points", "give 1 to 1000000");
    if (options.spp < 4 || options.spp > 1 << 20) throw Error("--spp", "give 4 to 1048576 paths a point");
    if (options.picture_spp < 2 || options.picture_spp > 1 << 20) throw Error("--picture-spp", "give 2 to 1048576");
}

BakeSettings base_settings(const ReportOptions& options, const LoadedScene& loaded, const std::vector<double>& hours) {
    BakeSettings base;
    base.light = loaded.light, base.unit = loaded.unit, base.lambert = loaded.lambert;
    base.error = target_error(options.quality, options.error);
    base.every_hours = parse_duration_hours("--every", options.every);
    if (!(base.every_hours >= 1.0 / 60.0)) throw Error("--every", "give a minute or more");
    base.seed = options.seed;
    if (options.quick) base.from_hour = hours.front(), base.to_hour = hours.back();
    return base;
}

std::vector<ViewAt> views_of(const ReportOptions& options, const LevelAtRest& level, const std::vector<double>& hours) {
    std::vector<std::pair<std::string, View>> cameras;
    if (options.view.camera.empty() && options.view.eye.empty() && options.view.at.empty() && !options.view.fov)
        for (const Camera& camera : level.loaded.scene.cameras)
            cameras.emplace_back(camera.name, camera_view(level.loaded.scene, level.pose, camera.name));
    if (cameras.empty())
        cameras.emplace_back(options.view.camera.empty() ? "view" : options.view.camera,
                             view_from_options(options.view, level.loaded.scene, level.pose));
    if (options.quick) cameras.resize(1);
    std::vector<ViewAt> views;
    for (const auto& [name, view] : cameras)
        for (const double hour : hours) views.push_back({name, view, hour});
    return views;
}

/// Everything that finished pieces depend on.
nlohmann::json key_of(const ReportOptions& options, const BakeSettings& base, const LevelAtRest& level) {
    const LightSettings& light = level.loaded.light;
    std::uint64_t images = 0;
    for (const Image8& image : level.loaded.scene.images)
        for (const std::uint8_t byte : image.rgba) images = images * 1099511628211ull + byte;
    return {
        {"program", file_hash("/proc/self/exe")},
        {"scene", file_hash(options.scene.scene)},
        {"geometry", geometry_hash(level.mesh)},
        {"images", images},
        {"day",
         {light.day.latitude, light.day.longitude, light.day.utc_offset, light.day.north, light.day.date.year,
          light.day.date.month, light.day.date.day}},
        {"light",
         {int(light.sun), int(light.sky), light.turbidity, light.clouds, light.sun_direction.x, light.sun_direction.y,
          light.sun_direction.z, light.sun_illuminance.x, light.sun_illuminance.y, light.sun_illuminance.z,
          light.sky_radiance.x, light.sky_radiance.y, light.sky_radiance.z, file_hash(light.sky_file)}},
        {"scene options", {level.loaded.unit, level.loaded.lambert}},
        {"view",
         {options.view.camera, options.view.eye, options.view.at, options.view.fov.value_or(0.0), options.view.size}},
        {"counts", {options.points, options.spp, options.picture_spp, options.threads, options.seed, options.quick}},
        {"hours", {options.hours, options.picture_hours, options.every, base.error}}};
}

std::string machine() {
    std::ifstream info("/proc/cpuinfo");
    std::string name = "unknown processor";
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
            name = line.substr(line.find(": ") + 2);
            break;
        }
    return name + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

/// Path counts that are far from the reference's own.
std::vector<int> traced_counts(int spp) {
    std::vector<int> counts;
    for (int count = 1; count <= spp / 8; count *= 4) counts.push_back(count);
    return counts;
}

/// The pictures' JSON is their errors; the radiance lies beside it.
PictureTruth picture_truth(Pieces& pieces, const LevelAtRest& level, const ViewAt& at, Size size, int spp) {
    const std::string name = "reference-" + at.view + "-" + clock_text(at.hour);
    const std::filesystem::path file = pieces.finished().path(name, ".exr");
    const auto trace = [&](const Progress& progress) {
        const PictureTruth truth = trace_picture(level, at, size, spp, progress);
        write_image(file, truth.radiance);
        return nlohmann::json(truth.standard_error);
    };
    const double error = pieces.get<nlohmann::json>(name, trace).get<double>();
    PictureTruth truth{at, read_image(file), 0.0, error};
    truth.ev = auto_ev(truth.radiance);
    return truth;
}

PointTruth point_truth(Pieces& pieces, const LevelAtRest& level, const std::string& name,
                       std::vector<SurfaceSample> points, const std::vector<double>& hours, int spp) {
    return pieces.get<PointTruth>("reference-" + name, [&](const Progress& progress) {
        return trace_points(level, std::move(points), hours, spp, progress);
    });
}

class ReportMaker {
  public:
    explicit ReportMaker(const ReportOptions& options)
        : options_(options),
          folder_(options.output),
          size_(parse_size(options.view.size)),
          hours_(parse_hours("--hours", options.hours)),
          picture_hours_(parse_hours("--picture-hours", options.picture_hours)),
          level_(options.scene),
          base_(base_settings(options, level_.loaded, hours_)),
          chosen_(chosen(options.methods, options.quick, base_)) {
        if (level_.mesh.triangle_count() == 0)
            throw Error(options.scene.scene, "has no triangles, so there is nothing to light and to report on");
    }

    Report make() {
        frames_ = FrameMaker::open(report_.no_pictures);
        if (!frames_) std::fprintf(stderr, "daylit: no pictures and no frame times: %s\n", report_.no_pictures.c_str());
        const std::vector<ViewAt> views = frames_ ? views_of(options_, level_, picture_hours_) : std::vector<ViewAt>();
        const int point_sets = chosen_.wants(false) + chosen_.wants(true);
        int total =
            int(views.size() + chosen_.studies.size()) + point_sets * (1 + int(traced_counts(options_.spp).size()));
        if (!views.empty()) total += int(traced_counts(options_.picture_spp).size());
        for (const ReportMethod& method : chosen_.methods) total += int(method.sweep.size());
        Pieces pieces(Finished(folder_ / "runs", key_of(options_, base_, level_)), total);
        make_folders();

        find_truth(pieces, views, chosen_.wants(false), chosen_.wants(true));
        const Judges judges{level_, surface_, space_, pictures_, frames_.get(), size_};
        trace(pieces, judges);
        for (const ReportMethod& method : chosen_.methods) sweep(pieces, method, judges);
        for (const ReportStudy& study : chosen_.studies) carry_out(pieces, study, judges);
        pieces.end();
        if (pieces.kept() > 0)
            std::fprintf(stderr, "daylit: %d of %d pieces were there from before\n", pieces.kept(), total);
        describe();
        return std::move(report_);
    }

  private:
    void make_folders() {
        std::error_code problem;
        std::filesystem::create_directories(folder_ / "pictures", problem);
        if (problem) throw Error(folder_.string(), "cannot be written to: " + problem.message());
    }

    void find_truth(Pieces& pieces, const std::vector<ViewAt>& views, bool on_surfaces, bool in_space) {
        const auto seed = options_.seed;
        if (on_surfaces)
            surface_ =
                point_truth(pieces, level_, "surface", sample_surface(level_.rays, level_.pose, options_.points, seed),
                            hours_, options_.spp);
        if (in_space) find_space_truth(pieces);
        for (const ViewAt& view : views) {
            pictures_.push_back(picture_truth(pieces, level_, view, size_, options_.picture_spp));
            const PictureTruth& truth = pictures_.back();
            const std::string file =
                "pictures/reference-" + file_name(view.view + "-" + clock_text(view.hour)) + ".png";
            write_image(folder_ / file, tonemap(truth.radiance, truth.ev));
            report_.pictures.push_back({view.view, view.hour, file, truth.standard_error});
        }
    }

    /// Not every scene has free space that can be found; what lives on surfaces is reported on all the same.
    void find_space_truth(Pieces& pieces) {
        std::vector<SurfaceSample> points;
        try {
            points = sample_space(level_.rays, level_.pose, options_.points, options_.seed);
        } catch (const Error& error) {
            no_space_ = error.what();
            return;
        }
        space_ = point_truth(pieces, level_, "space", std::move(points), hours_, options_.spp);
    }

    void trace(Pieces& pieces, const Judges& judges) {
        for (const auto& [axis, truth] : {std::pair("surface", &surface_), std::pair("space", &space_)})
            for (const int spp : traced_counts(truth->points.empty() ? 0 : options_.spp))
                report_.traced.push_back(pieces.get<RunResult>(
                    std::string("traced-") + axis + "-" + std::to_string(spp),
                    [&](const Progress& progress) { return run_traced_points(axis, *truth, spp, level_, progress); }));
        for (const int spp : traced_counts(pictures_.empty() ? 0 : options_.picture_spp))
            report_.traced.push_back(pieces.get<RunResult>(
                "traced-pictures-" + std::to_string(spp),
                [&](const Progress& progress) { return run_traced_pictures(spp, judges, progress); }));
    }

    void sweep(Pieces& pieces, const ReportMethod& method, const Judges& judges) {
        ReportedMethod reported{method.name,
                                method.about,
                                method.in_space,
                                method.in_pictures,
                                (method.in_space ? space_ : surface_).standard_error,
                                {}};
        if (method.in_space && space_.points.empty()) {
            reported.runs.push_back({.method = method.name, .axis = "base", .name = "base", .failure = no_space_});
            report_.methods.push_back(std::move(reported));
            return;
        }
        for (const SweepPoint& point : method.sweep)
            reported.runs.push_back(
                pieces.get<RunResult>(method.name + "-" + point.name, [&](const Progress& progress) {
                    return run_point(method, point, judges, folder_, point.axis == "base", progress);
                }));
        std::vector<RunResult> alike;
        for (const RunResult& run : report_.traced)
            if (run.axis == (method.in_space ? "space" : "surface")) alike.push_back(run);
        compare_with_traced(reported.runs, alike);
        report_.methods.push_back(std::move(reported));
    }

    void carry_out(Pieces& pieces, const ReportStudy& study, const Judges& judges) {
        const PointTruth& truth = study.in_space ? space_ : surface_;
        const StudyResult result = pieces.get<StudyResult>(study.name, [&](const Progress& progress) {
            StudyResult made;
            try {
                if (truth.points.empty()) throw Error("not compared", no_space_);
                made = study.run(judges, progress);
            } catch (const Error& error) {
                made.runs = {{.method = study.name, .axis = "base", .name = "base", .failure = error.what()}};
            }
            return made;
        });
        report_.methods.push_back(
            {study.name, study.about, study.in_space, false, truth.standard_error, result.runs, result.findings});
    }

    void describe() {
        report_.scene = std::filesystem::path(options_.scene.scene).filename().string();
        report_.machine = machine();
        if (frames_) report_.driver = frames_->driver();
        const auto truth_line = [&](const char* what, const PointTruth& truth) {
            if (truth.points.empty()) return std::string();
            return std::to_string(truth.points.size()) + " points " + what + " by " + std::to_string(options_.spp) +
                   " paths each (standard error " + written(truth.standard_error, Unit::Share) + "); ";
        };
        std::string hours;
        for (const double hour : hours_) hours += (hours.empty() ? "" : ", ") + clock_text(hour);
        report_.settings = "Judged by path tracing: " + truth_line("on surfaces", surface_) +
                           truth_line("in free space", space_) + "at " + hours + " o'clock. Bakes for an error of " +
                           written(base_.error, Unit::Share) + " but for what each names.";
        if (!pictures_.empty())
            report_.settings += " Pictures of " + std::to_string(size_.width) + " x " + std::to_string(size_.height) +
                                " by " + std::to_string(options_.picture_spp) + " paths a pixel.";
    }

    const ReportOptions& options_;
    std::filesystem::path folder_;
    Size size_;
    std::vector<double> hours_, picture_hours_;
    LevelAtRest level_;
    BakeSettings base_;
    Chosen chosen_;
    std::unique_ptr<FrameMaker> frames_;
    PointTruth surface_, space_;
    std::string no_space_;  // why there are no points in space
    std::vector<PictureTruth> pictures_;
    Report report_;
};

nlohmann::json json_of(const Report& report, const std::vector<RunResult>& runs) {
    nlohmann::json json = {
        {"scene", report.scene},       {"machine", report.machine},         {"driver", report.driver},
        {"settings", report.settings}, {"no_pictures", report.no_pictures}, {"runs", runs}};
    for (const ReportedMethod& method : report.methods) {
        json["standard_error"][method.in_space ? "space" : "surface"] = method.standard_error;
        for (const Finding& finding : method.findings) json["findings"][method.name][finding.key] = finding.value;
    }
    for (const ReportedPicture& p : report.pictures)
        json["pictures"].push_back(
            {{"view", p.view}, {"hour", p.hour}, {"reference", p.reference}, {"standard_error", p.standard_error}});
    return json;
}

void run(const CLI::App& command, ReportOptions options) {
    apply_quick(command, options);
    check_counts(options);
    const ThreadLimit threads(options.threads);
    const Report report = ReportMaker(options).make();

    std::vector<RunResult> runs;
    for (const ReportedMethod& method : report.methods) runs.insert(runs.end(), method.runs.begin(), method.runs.end());
    if (!runs.empty() && std::all_of(runs.begin(), runs.end(), [](const RunResult& r) { return !r.failure.empty(); }))
        throw Error(options.scene.scene, "no method could be measured; the first said: " + runs.front().failure);
    runs.insert(runs.end(), report.traced.begin(), report.traced.end());
    const std::filesystem::path folder = options.output;
    const std::string json = json_of(report, runs).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    write_file(folder / "report.json", json);
    write_file(folder / "report.csv", csv_text(runs));
    write_file(folder / "index.html", page(report));
    if (options.json) std::fputs(json.c_str(), stdout);
    std::fprintf(stderr, "daylit: see %s\n", (folder / "index.html").c_str());
}

}  // namespace

void add_report(CLI::App& app) {
    CLI::App* command = app.add_subcommand("report", "error against time and memory for each method on SCENE");
    const auto options = std::make_shared<ReportOptions>();
    options->view.size = "480x270";
    add_scene_options(*command, options->scene);
    add_camera_options(*command, options->view);
    const std::string group = "Report";
    command->add_option("-o", options->output, "folder for index.html, report.csv, report.json and the pictures")
        ->required();
    command->add_flag("--quick", options->quick, "few points, paths, hours and settings, one small picture")
        ->group(group);
    command
        ->add_option("--methods", options->methods,
                     "all, or a list of lightmap, volume, encodings, whole-day, seen-frames, volume-modes")
        ->group(group)
        ->capture_default_str();
    command->add_option("--points", options->points, "places to judge at")->group(group)->capture_default_str();
    command->add_option("--spp", options->spp, "paths a point of the reference")->group(group)->capture_default_str();
    command->add_option("--picture-spp", options->picture_spp, "paths a pixel of the reference")
        ->group(group)
        ->capture_default_str();
    command->add_option("--hours", options->hours, "H,H,... to judge at points (default 6,9,12,15,18,21)")
        ->group(group);
    command->add_option("--picture-hours", options->picture_hours, "H,H,... to judge pictures at (default 9,12,18)")
        ->group(group);
    CLI::Option* quality =
        command->add_option("--quality", options->quality, "of the base settings: preview | medium | high")
            ->group(group)
            ->capture_default_str();
    command->add_option("--error", options->error, "target relative error instead of a quality")
        ->group(group)
        ->excludes(quality);
    command->add_option("--every", options->every, "time between keyframes of the bakes")
        ->group(group)
        ->capture_default_str();
    add_seed(*command, options->seed, "of points and bakes")->group(group);
    command->add_option("--threads", options->threads, "0: all cores")->group(group)->capture_default_str();
    command->add_flag("--json", options->json, "report.json on stdout too")->group(group);
    command->callback([options, command] { run(*command, *options); });
}

}  // namespace daylit
