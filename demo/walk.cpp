// daylit walk: a window to walk through a level while the day goes by.
#include <CLI/App.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "demo/commands.h"
#include "demo/options.h"
#include "demo/walk/walk_loop.h"

namespace daylit {
namespace {

struct WalkOptions {
    SceneOptions scene;
    ViewOptions view;
    std::string light, volume_mode = "auto";
};

/// --light, else the baked file beside the scene, else none.
std::string light_file(const WalkOptions& options) {
    if (!options.light.empty()) return options.light;
    const std::filesystem::path beside = std::filesystem::path(options.scene.scene).replace_extension(".daylit");
    std::error_code ignored;
    if (std::filesystem::exists(beside, ignored)) return beside.string();
    if (!std::filesystem::exists(options.scene.scene, ignored)) return {};  // that is told when it is opened
    std::fprintf(stderr, "no baked light at %s: indirect light is zero ('daylit bake %s' makes it)\n", beside.c_str(),
                 options.scene.scene.c_str());
    return {};
}

std::vector<Bookmark> scene_bookmarks(const Scene& scene, const Pose& pose) {
    std::vector<Bookmark> bookmarks;
    for (const Camera& camera : scene.cameras) {
        bookmarks.push_back({camera.name, gaze_from_view(camera_view(scene, pose, camera.name))});
    }
    return bookmarks;
}

void walk(const WalkOptions& options) {
    WalkStart start;
    WalkState& state = start.state;
    state.hour = parse_hour("--hour", options.view.hour);
    state.show = parse_layer(options.view.show);
    state.volume_view = state.show == Layer::Volume;
    state.volume_mode = parse_volume_mode(options.volume_mode);
    start.size = parse_size(options.view.size);
    start.seconds = seconds_of(options.view);
    if (const std::optional<double> ev = parse_ev(options.view.ev)) {
        state.auto_exposure = false;
        state.ev = float(*ev);
    }
    const std::string light = light_file(options);
    const LoadedScene loaded = load(options.scene, light);
    require_part(state.show, loaded, light);
    start.moves = parse_moves(loaded.scene, options.view.moves);
    const Pose pose = pose_scene(loaded.scene, start.seconds, start.moves);
    state.light = loaded.light;
    state.gaze = gaze_from_view(view_from_options(options.view, loaded.scene, pose));
    state.bookmarks = scene_bookmarks(loaded.scene, pose);
    walk_loop(loaded, start);
}

}  // namespace

void add_walk(CLI::App& app) {
    CLI::App* command = app.add_subcommand("walk", "walk through a level in a window, and drag the sun along its day");
    auto options = std::make_shared<WalkOptions>();
    add_scene_options(*command, options->scene);
    add_view_options(*command, options->view);
    command->add_option("--light", options->light, "baked light (default: FILE.daylit beside the scene, if there)");
    add_volume_mode(*command, options->volume_mode);
    command->callback([options] { walk(*options); });
}

}  // namespace daylit
