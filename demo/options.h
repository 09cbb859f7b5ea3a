#pragma once
// Options that several subcommands share, and how what is given, baked, in the scene and by default combine.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "demo/parse.h"
#include "engine/baked/baked_file.h"
#include "engine/scene/gltf.h"
#include "engine/scene/layer.h"
#include "engine/scene/pose.h"
#include "engine/scene/sky.h"

namespace CLI {
class App;
class Option;
}

namespace daylit {

/// SCENE with place, day, sun, sky, unit and materials. What is not given comes from the baked file, then from the
/// scene's extras.daylit, then from the defaults.
struct SceneOptions {
    std::string scene;
    std::optional<double> latitude, longitude, utc_offset, north, turbidity, clouds, unit;
    std::optional<std::string> date, sun, sun_direction, sun_lux, sky, materials;
};
void add_scene_options(CLI::App& app, SceneOptions& options);

/// Baked file named by --light (or none), its settings respected by the loads below.
struct LoadedScene {
    Scene scene;
    std::optional<Baked> baked;
    LightSettings light;
    double unit = 1.0;
    bool lambert = false;
};
/// light_file empty: no baked file.
LoadedScene load(const SceneOptions& options, const std::string& light_file = {});

/// Where the camera stands, when it is, how large the picture is.
struct ViewOptions {
    std::string camera, eye, at;
    std::optional<double> fov;  // vertical, degrees, of the free camera
    std::string hour = "12";
    std::string size = "1280x720";
    std::string show = "final";
    std::string ev = "auto";
    std::vector<std::string> moves;
    double time = 0.0;  // seconds on the animations' clocks
};
/// Camera and size.
void add_camera_options(CLI::App& app, ViewOptions& options);
/// All of it.
void add_view_options(CLI::App& app, ViewOptions& options, bool with_hour = true);

/// --volume-mode, for commands that draw.
void add_volume_mode(CLI::App& app, std::string& mode);

/// EV100, or none for "auto".
std::optional<double> parse_ev(const std::string& text);
/// NODE=x,y,z[,yaw in degrees]; the error lists the nodes there are.
std::vector<NodeMove> parse_moves(const Scene& scene, const std::vector<std::string>& moves);
/// --time, checked.
double seconds_of(const ViewOptions& options);
/// throws when the layer is a part of a baked file and the scene came with none, or with one without that part.
void require_part(Layer layer, const LoadedScene& loaded, const std::string& light_file);
/// The relative error that --quality stands for, or the one given by --error instead.
double target_error(const std::string& quality, const std::optional<double>& error);
/// --seed; also refuses what is negative, which would be read as another number.
CLI::Option* add_seed(CLI::App& app, std::uint64_t& seed, const char* about);
/// --camera, else --eye/--at/--fov, else the first camera, else an overview of the scene.
View view_from_options(const ViewOptions& options, const Scene& scene, const Pose& pose);

}  // namespace daylit
