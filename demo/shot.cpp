// daylit shot: one picture, off-screen.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "demo/commands.h"
#include "demo/output.h"
#include "demo/picture.h"

namespace daylit {
namespace {

struct ShotOptions {
    PictureOptions picture;
    std::string output;
    bool json = false;
};

nlohmann::json pass_json(const PassReport& pass, bool timed) {
    nlohmann::json json = {{"name", pass.name}, {"ran", pass.ran}, {"why", pass.why}};
    if (!pass.ran) return json;
    json["draws"] = pass.draws;
    json["triangles"] = pass.triangles;
    if (timed) {
        json["milliseconds"] = pass.milliseconds;
        json["processor_milliseconds"] = pass.processor_milliseconds;
    }
    return json;
}

void print_json(const ShotOptions& options, const Photographer& photographer, const Picture& picture, double seconds) {
    nlohmann::json json = {{"output", options.output},
                           {"width", picture.radiance.width},
                           {"height", picture.radiance.height},
                           {"driver", photographer.driver()},
                           {"ev", picture.ev},
                           {"seconds", seconds},
                           {"clusters_drawn", picture.report.objects_drawn},
                           {"clusters_culled", picture.report.objects_culled}};
    double frame = 0.0, processor = 0.0;
    for (const PassReport& pass : picture.report.passes) {
        json["passes"].push_back(pass_json(pass, options.picture.frames > 1));
        frame += pass.milliseconds;
        processor += pass.processor_milliseconds;
    }
    if (options.picture.frames > 1) {
        json["frame_milliseconds"] = frame;
        json["frame_processor_milliseconds"] = processor;
    }
    std::printf("%s\n", json.dump(2).c_str());
}

constexpr int kMeasuredSamplesPerSide = 4;  // of .exr, which is made to be compared: an edge then errs by 1/16

void shoot(const ShotOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    check_output(options.output, {".png", ".exr"});
    check_apart(options.output, {options.picture.scene.sky.value_or("")});
    PictureOptions how = options.picture;
    if (!how.samples_per_side && std::filesystem::path(options.output).extension() == ".exr")
        how.samples_per_side = kMeasuredSamplesPerSide;
    const double hour = parse_hour("--hour", options.picture.view.hour);
    Photographer photographer(how);
    const Picture picture = photographer.take(hour, seconds_of(options.picture.view));
    write_picture(options.output, picture, parse_layer(options.picture.view.show));
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    if (options.json) print_json(options, photographer, picture, spent.count());
}

}  // namespace

void add_shot(CLI::App& app) {
    CLI::App* command = app.add_subcommand("shot", "Takes one picture with the renderer, off-screen");
    const auto options = std::make_shared<ShotOptions>();
    add_picture_options(*command, options->picture);
    command->add_option("-o,--output", options->output, "picture, .png (as displayed) or .exr (linear, cd/m^2)")
        ->required();
    command->add_flag("--json", options->json, "report on stdout: passes, draws, times");
    command->callback([options] { shoot(*options); });
}

}  // namespace daylit
