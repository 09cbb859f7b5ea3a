// daylit bake: works out the indirect light of a level's day and writes it beside the scene.
#include <CLI/App.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "demo/commands.h"
#include "demo/info.h"
#include "demo/options.h"
#include "demo/output.h"
#include "demo/progress.h"
#include "demo/traced_scene.h"
#include "engine/base/error.h"
#include "engine/scene/gltf_export.h"
#include "gi/bake.h"

namespace daylit {
namespace {

struct BakeOptions {
    SceneOptions scene;
    std::string output, export_glb, quality = "preview", parts = "auto", hours = "0-24", every = "5m";
    std::string directional = "auto";
    std::optional<double> error;
    int bounces = 64, threads = 0;
    std::uint64_t seed = 1;
    bool resume = false, keep_uv2 = false, json = false;
    VolumeSettings volume;
};

bool directional_of(const BakeOptions& options) {
    if (options.directional == "auto") return true;
    if (options.directional == "off") return false;
    throw UsageError("--directional", "'" + options.directional + "' is not one of auto, off");
}

std::vector<std::string> parts_of(const std::string& text) {
    if (text == "auto") return {};
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, comma - begin);
        if (part != "lightmap" && part != "volume" && part != "dirmap" && part != "antiradiance" && part != "caustics")
            throw UsageError("--parts",
                             "'" + part + "' is not one of auto, lightmap, volume, dirmap, antiradiance, caustics");
        parts.push_back(part);
        begin = comma + 1;
    }
    return parts;
}

void read_hours(const BakeOptions& options, BakeSettings& settings) {
    const std::size_t dash = options.hours.find('-', 1);
    if (dash == std::string::npos)
        throw UsageError("--hours", "'" + options.hours + "' is not FROM-TO, as in 0-24 or 6-20");
    const std::string from = options.hours.substr(0, dash), to = options.hours.substr(dash + 1);
    settings.from_hour = parse_hour("--hours", from);
    settings.to_hour = to == "24" || to == "24:00" ? 24.0 : parse_hour("--hours", to);
    if (settings.to_hour < settings.from_hour)
        throw Error("--hours", "ends before it begins; give FROM-TO within one day");
    settings.every_hours = parse_duration_hours("--every", options.every);
    if (!(settings.every_hours >= 1.0 / 60.0)) throw Error("--every", "give a minute or more");
}

void add_volume_options(CLI::App& app, VolumeSettings& volume) {
    const std::string group = "Irradiance volume: what follows from the error unless it is given";
    const std::string levels = ", 0 (an eighth of the level's longest side) to 20";
    app.add_option("--volume-min-level", volume.min_level,
                   "cells are split until this level whatever light does" + levels)
        ->group(group);
    app.add_option("--volume-max-level", volume.max_level, "and never below this one (default: cells of 0.25 m)")
        ->group(group);
    app.add_option("--volume-geometry-level", volume.geometry_level,
                   "cells with surfaces in them are split until this level")
        ->group(group);
    app.add_option("--volume-change", volume.change,
                   "splits where light changes over the cell by more than this share of it")
        ->group(group);
    app.add_option("--volume-near", volume.harmonic_mean,
                   "splits where the harmonic mean distance of what a corner sees is below this many sides")
        ->group(group);
    app.add_option("--volume-error", volume.error, "splits where light inside differs from the corners' by this share")
        ->group(group);
    app.add_option("--volume-cells", volume.most_cells, "the number of cells that ends refinement")->group(group);
}

void check(const VolumeSettings& volume) {
    const auto check_level = [](const char* option, int level) {
        if (level < 0 || level > glsl::kVolumeMostLevels) throw Error(option, "give 0 to 20");
    };
    check_level("--volume-min-level", volume.min_level);
    check_level("--volume-geometry-level", volume.geometry_level);
    if (volume.max_level != VolumeSettings{}.max_level) check_level("--volume-max-level", volume.max_level);
    if (volume.max_level >= 0 && volume.max_level < volume.min_level)
        throw Error("--volume-max-level", "is coarser than --volume-min-level");
    if (!(volume.change > 0.0f)) throw Error("--volume-change", "give a share above 0");
    if (!(volume.harmonic_mean >= 0.0f && volume.harmonic_mean <= 1e6f))
        throw Error("--volume-near", "give 0 to 1000000");
    if (!(volume.error >= 0.0f && volume.error <= 10.0f)) throw Error("--volume-error", "give a share of at most 10");
}

BakeSettings settings_from(const BakeOptions& options) {
    BakeSettings settings;
    settings.directional = directional_of(options);
    settings.error = target_error(options.quality, options.error);
    settings.parts = parts_of(options.parts);
    settings.seed = options.seed;
    settings.keep_uv2 = options.keep_uv2;
    if (options.bounces < 0 || options.bounces > 10000) throw Error("--bounces", "give 0 to 10000");
    settings.bounces = options.bounces;
    read_hours(options, settings);
    check(options.volume);
    settings.volume = options.volume;
    return settings;
}

void write_layout(const Scene& scene, const Baked& baked, const std::string& path) {
    if (!baked.lightmap) throw Error("--export-glb", "there is no lightmap whose layout could be written");
    const WorldMesh mesh = world_mesh(scene, pose_scene(scene), Part::Static);
    export_glb(scene, mesh, baked.lightmap->corner_uvs, {baked.lightmap->width, baked.lightmap->height}, path);
}

void run(const BakeOptions& options) {
    const std::filesystem::path output = options.output.empty()
                                             ? std::filesystem::path(options.scene.scene).replace_extension(".daylit")
                                             : std::filesystem::path(options.output);
    check_output(output.string(), {".daylit"});
    if (!options.export_glb.empty()) {
        check_output(options.export_glb, {".glb"});
        check_apart(options.export_glb, {options.scene.scene});
    }
    BakeSettings settings = settings_from(options);
    // Beside the result, so that it lies where there is room and is found again; no glTF or baked file has this name.
    settings.checkpoint = output;
    settings.checkpoint += ".part";
    settings.resume = options.resume;
    const ThreadLimit threads(options.threads);
    const LoadedScene loaded = load(options.scene);
    settings.light = loaded.light, settings.unit = loaded.unit, settings.lambert = loaded.lambert;

    const auto start = std::chrono::steady_clock::now();
    try {
        const Baked baked = bake(loaded.scene, settings, make_progress("bake"));
        if (!options.export_glb.empty()) write_layout(loaded.scene, baked, options.export_glb);
        write_baked(output, baked);
    } catch (const Interrupted&) {
        throw Stopped("stopped; what was traced is kept in " + settings.checkpoint.string() +
                      ", and the same command with --resume goes on from there");
    }
    std::error_code ignored;
    std::filesystem::remove(settings.checkpoint, ignored);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    nlohmann::json about = describe_baked(output);
    about["seconds"] = seconds;
    if (options.json)
        std::printf("%s\n", about.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    else
        std::fprintf(stderr, "%s\n", summary(about).c_str());
}

}  // namespace

void add_bake(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bake", "work out the indirect light of SCENE over the day");
    const auto options = std::make_shared<BakeOptions>();
    add_scene_options(*command, options->scene);
    const std::string group = "Bake";
    command->add_option("-o", options->output, "file to write (default: beside the scene, .daylit)")->group(group);
    CLI::Option* quality =
        command->add_option("--quality", options->quality, "preview (error 0.10) | medium (0.03) | high (0.01)")
            ->group(group)
            ->capture_default_str();
    command->add_option("--error", options->error, "target relative error instead of a quality")
        ->group(group)
        ->excludes(quality);
    command
        ->add_option("--parts", options->parts, "auto, or a list of lightmap, volume, dirmap, antiradiance, caustics")
        ->group(group)
        ->capture_default_str();
    command
        ->add_option("--directional", options->directional,
                     "auto (lightmaps under normal maps know how light changes with the normal) | off")
        ->group(group)
        ->capture_default_str();
    command->add_option("--hours", options->hours, "FROM-TO, local clock")->group(group)->capture_default_str();
    command->add_option("--every", options->every, "time between the hours that are baked, as in 5m or 0.5h")
        ->group(group)
        ->capture_default_str();
    command->add_option("--bounces", options->bounces, "at most; ends when the rest no longer counts")
        ->group(group)
        ->capture_default_str();
    add_seed(*command, options->seed, "of the random numbers")->group(group);
    command->add_option("--threads", options->threads, "0: all cores")->group(group)->capture_default_str();
    command
        ->add_flag("--keep-uv2", options->keep_uv2,
                   "the lightmap's layout is the scene's own TEXCOORD_1, not a new one")
        ->group(group);
    command
        ->add_option("--export-glb", options->export_glb,
                     "also write the scene with the lightmap's layout as TEXCOORD_1, for other engines")
        ->group(group);
    command->add_flag("--resume", options->resume, "go on from an interrupted bake")->group(group);
    command->add_flag("--json", options->json, "what was baked, as `info --json`, and the seconds it took")
        ->group(group);
    add_volume_options(*command, options->volume);
    command->callback([options] { run(*options); });
}

}  // namespace daylit
