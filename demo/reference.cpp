// daylit reference: the picture that shot is judged by, path-traced without bias.
#include <CLI/App.hpp>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "demo/commands.h"
#include "demo/output.h"
#include "demo/progress.h"
#include "demo/traced_scene.h"
#include "engine/base/error.h"
#include "engine/base/exposure.h"
#include "gi/transport/path_trace/path_trace.h"

namespace daylit {
namespace {

struct ReferenceOptions {
    SceneOptions scene;
    ViewOptions view;
    std::string output, light;
    int spp = 64, bounces = 1000, threads = 0;
    std::optional<double> error;
    std::uint64_t seed = 1;
    bool json = false;
};

/// The command as given, for the picture's header.
std::string command_line(const CLI::App& app) {
    std::string line = "daylit " + app.get_name();
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() == 0) continue;
        for (const std::string& value : option->results())
            line += (option->get_positional() ? " " : " " + option->get_name() + " ") + value;
    }
    return line;
}

PathTraceSettings settings_from(const ReferenceOptions& options) {
    if (options.spp < 1 || options.spp > 1 << 20) throw Error("--spp", "give 1 to 1048576 samples per pixel");
    if (options.error) check_range("--error", *options.error, 1e-5, 1.0);
    if (options.bounces < 0 || options.bounces > 100000) throw Error("--bounces", "give 0 to 100000");
    const Layer layer = parse_layer(options.view.show);
    if (layer > Layer::Depth)
        throw Error("--show", "'" + options.view.show + "' is a part of a baked file, which only shot can show");
    return {.spp = options.spp,
            .error = options.error.value_or(0.0),
            .max_bounces = options.bounces,
            .seed = options.seed,
            .layer = layer};
}

/// PNG shows what a display would; EXR keeps the numbers.
Image for_output(const Image& picture, const ReferenceOptions& options, Layer layer) {
    const bool numbers = options.output.ends_with(".exr");
    const bool shown_as_is = layer == Layer::Albedo || layer == Layer::Normal;
    if (numbers || shown_as_is) return picture;
    return tonemap(picture, parse_ev(options.view.ev).value_or(auto_ev(picture)));
}

nlohmann::json report(const PathTraceImage& picture, double seconds) {
    glm::dvec3 sum(0.0);
    for (const Rgb& p : picture.radiance.pixels) sum += glm::dvec3(p);
    const glm::dvec3 mean = sum / double(picture.radiance.pixels.size());
    nlohmann::json json = {{"width", picture.radiance.width},
                           {"height", picture.radiance.height},
                           {"spp", picture.spp},
                           {"relative_error", nullptr},
                           {"mean", {mean.r, mean.g, mean.b}},
                           {"seconds", seconds},
                           {"rays", picture.rays},
                           {"rays_per_second", double(picture.rays) / seconds}};
    if (picture.relative_error >= 0.0) json["relative_error"] = picture.relative_error;
    return json;
}

std::string header(const std::string& command, const PathTraceImage& picture) {
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, "; %d spp, relative standard error %.3g", picture.spp,
                  picture.relative_error);
    return command + (picture.relative_error < 0.0 ? "; 1 spp" : numbers);
}

void run(const ReferenceOptions& options, const std::string& command) {
    check_output(options.output, {".exr", ".png"});
    check_apart(options.output, {options.scene.sky.value_or("")});
    const Size size = parse_size(options.view.size);
    const PathTraceSettings settings = settings_from(options);
    parse_ev(options.view.ev);
    const ThreadLimit threads(options.threads);
    const TracedScene scene(options.scene, options.light, options.view.hour, options.view.moves,
                            seconds_of(options.view));
    const View view = view_from_options(options.view, scene.loaded.scene, scene.pose);

    const auto start = std::chrono::steady_clock::now();
    const PathTraceImage picture = path_trace(scene.rays, scene.lighting, scene.lamps, view, size.width, size.height,
                                              settings, make_progress("reference"));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    write_image(options.output, for_output(picture.radiance, options, settings.layer), header(command, picture));
    if (options.json) std::printf("%s\n", report(picture, seconds).dump(2).c_str());
}

}  // namespace

void add_reference(CLI::App& app) {
    CLI::App* command = app.add_subcommand("reference", "path-trace a picture without bias, to judge the others by");
    const auto options = std::make_shared<ReferenceOptions>();
    add_scene_options(*command, options->scene);
    add_view_options(*command, options->view);
    command->add_option("-o", options->output, "picture to write: .exr (linear, cd/m^2) or .png (as displayed)")
        ->required();
    command->add_option("--light", options->light, "baked file whose place, day, sun and sky to use");
    command->add_option("--spp", options->spp, "samples per pixel; with --error: of the first round")
        ->capture_default_str();
    command->add_option("--error", options->error, "go on until the RMS standard error over the mean is below this");
    command->add_option("--bounces", options->bounces, "segments past the first surface")->capture_default_str();
    add_seed(*command, options->seed, "of the random numbers");
    command->add_option("--threads", options->threads, "0: all cores")->capture_default_str();
    command->add_flag("--json", options->json, "spp, error, mean, seconds and rays per second on stdout");
    command->callback([options, command] { run(*options, command_line(*command)); });
}

}  // namespace daylit
