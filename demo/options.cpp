#include "demo/options.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/vec.h"

namespace daylit {
namespace {

template <typename T>
void choose(T& value, const std::optional<T>& given) {
    if (given) value = *given;
}

/// The scene's extras, where the file says something.
void apply(LightSettings& light, const SceneExtras& extras) {
    choose(light.day.latitude, extras.latitude);
    choose(light.day.longitude, extras.longitude);
    choose(light.day.date, extras.date);
    choose(light.day.utc_offset, extras.utc_offset);
    choose(light.day.north, extras.north);
    choose(light.turbidity, extras.turbidity);
    choose(light.clouds, extras.clouds);
}

void apply_sun(LightSettings& light, const SceneOptions& options) {
    if (options.sun) {
        if (*options.sun == "day")
            light.sun = SunSource::Day;
        else if (*options.sun == "scene")
            light.sun = SunSource::Scene;
        else if (*options.sun == "none")
            light.sun = SunSource::None;
        else
            throw UsageError("--sun", "'" + *options.sun + "' is not one of day, scene, none");
    }
    if (options.sun_direction) {
        if (options.sun)
            throw UsageError("--sun-direction", "is a sun of its own; leave --sun " + *options.sun + " out");
        light.sun = SunSource::Given;
        light.sun_direction = unit_or(parse_vec3("--sun-direction", *options.sun_direction), Vec3(0.0f));
        if (light.sun_direction == Vec3(0.0f)) throw Error("--sun-direction", "0,0,0 points nowhere");
    }
    if (options.sun_lux) {
        if (light.sun != SunSource::Given) {
            throw UsageError("--sun-lux", "is the strength of the sun of --sun-direction; give that too");
        }
        light.sun_illuminance = parse_rgb("--sun-lux", *options.sun_lux);
    }
}

void apply_sky(LightSettings& light, const std::string& sky) {
    const auto ends_with = [&](const char* end) { return sky.size() > 4 && sky.ends_with(end); };
    if (sky == "day") {
        light.sky = SkySource::Day;
    } else if (sky == "none") {
        light.sky = SkySource::None;
    } else if (ends_with(".exr") || ends_with(".hdr")) {
        light.sky = SkySource::File;
        light.sky_file = sky;
    } else if (sky.find_first_not_of("0123456789.,+-eE") == std::string::npos) {
        light.sky = SkySource::Constant;
        light.sky_radiance = parse_rgb("--sky", sky);
    } else {
        throw UsageError("--sky", "'" + sky + "' is not one of day, none, FILE.exr, FILE.hdr, r,g,b");
    }
}

void check(const LightSettings& light) {
    check_range("--latitude", light.day.latitude, -90, 90);
    check_range("--longitude", light.day.longitude, -180, 180);
    check_range("--utc-offset", light.day.utc_offset, -14, 14);
    check_range("--north", light.day.north, -360, 360);
    check_range("--turbidity", light.turbidity, 1, 10);
    check_range("--clouds", light.clouds, 0, 1);
}

void apply(LightSettings& light, const SceneOptions& options) {
    choose(light.day.latitude, options.latitude);
    choose(light.day.longitude, options.longitude);
    choose(light.day.utc_offset, options.utc_offset);
    choose(light.day.north, options.north);
    choose(light.turbidity, options.turbidity);
    choose(light.clouds, options.clouds);
    if (options.date) light.day.date = parse_date(*options.date);
    apply_sun(light, options);
    if (options.sky) apply_sky(light, *options.sky);
    check(light);
}

bool wants_lambert(const SceneOptions& options, bool otherwise) {
    if (!options.materials) return otherwise;
    if (*options.materials == "lambert") return true;
    if (*options.materials == "full") return false;
    throw UsageError("--materials", "'" + *options.materials + "' is not one of full, lambert");
}

std::string node_names(const Scene& scene) {
    std::string list;
    for (const Node& node : scene.nodes) {
        if (node.name.empty()) continue;
        if (list.size() > 400) return list + ", ...";
        list += (list.empty() ? "" : ", ") + node.name;
    }
    return list.empty() ? "no node has a name" : list;
}

constexpr double kMaxYaw = 36000;          // degrees: a hundred turns; a float still tells 1/100 of one
constexpr double kMaxAnimationTime = 1e6;  // seconds, twelve days, of which a float tells 1/16

NodeMove parse_move(const Scene& scene, const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos) throw UsageError("--move", "'" + text + "' is not NODE=x,y,z[,yaw]");
    const std::string name = text.substr(0, equals);
    std::string place = text.substr(equals + 1);
    NodeMove move;
    if (std::count(place.begin(), place.end(), ',') == 3) {
        const std::size_t comma = place.rfind(',');
        move.yaw = float(parse_number("--move", place.substr(comma + 1), -kMaxYaw, kMaxYaw) * kDegree);
        place.resize(comma);
    }
    move.position = parse_place("--move", place);
    const auto node =
        std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
    if (node == scene.nodes.end()) {
        throw Error("--move", "no node '" + name + "' in " + scene.path.string() + "; there are " + node_names(scene));
    }
    move.node = int(node - scene.nodes.begin());
    return move;
}

}  // namespace

void add_scene_options(CLI::App& app, SceneOptions& options) {
    app.add_option("SCENE", options.scene, "glTF 2.0 scene, .gltf or .glb")->required();
    const std::string group = "Place, day, sun and sky";
    app.add_option("--latitude", options.latitude, "degrees north (default Koldinghus, 55.4917)")->group(group);
    app.add_option("--longitude", options.longitude, "degrees east (default 9.4733)")->group(group);
    app.add_option("--date", options.date, "YYYY-MM-DD (default 2026-06-21)")->group(group);
    app.add_option("--utc-offset", options.utc_offset, "hours of the local clock ahead of UTC (default 2)")
        ->group(group);
    app.add_option("--north", options.north, "degrees clockwise from -Z, seen from above (default 0)")->group(group);
    app.add_option("--sun", options.sun, "day | scene (the file's directional lights) | none")->group(group);
    app.add_option("--sun-direction", options.sun_direction, "x,y,z towards a sun that stands still")->group(group);
    app.add_option("--sun-lux", options.sun_lux, "its illuminance facing it: E or r,g,b (default 90000)")->group(group);
    app.add_option("--sky", options.sky, "day | none | FILE.exr | FILE.hdr | r,g,b in cd/m^2")->group(group);
    app.add_option("--turbidity", options.turbidity, "haze of the clear sky, 1 to 10 (default 2.5)")->group(group);
    app.add_option("--clouds", options.clouds, "share of the sky covered, 0 to 1 (default 0)")->group(group);
    app.add_option("--unit", options.unit, "metres per file unit (default 1)")->group(group);
    app.add_option("--materials", options.materials, "full | lambert (base colour and emission only)")->group(group);
}

LoadedScene load(const SceneOptions& options, const std::string& light_file) {
    LoadedScene loaded;
    if (!light_file.empty()) loaded.baked = read_baked(light_file);
    const Baked* baked = loaded.baked ? &*loaded.baked : nullptr;
    if (options.unit) check_range("--unit", *options.unit, 1e-6, 1e6);
    loaded.lambert = wants_lambert(options, baked && baked->lambert);
    loaded.unit = options.unit.value_or(baked ? baked->unit : 0.0);
    loaded.scene = load_scene(options.scene, {.unit = loaded.unit, .lambert = loaded.lambert});
    if (loaded.unit == 0.0) loaded.unit = loaded.scene.extras.unit.value_or(1.0);
    if (baked) {
        require_same_geometry(*baked, light_file, world_mesh(loaded.scene, pose_scene(loaded.scene), Part::Static),
                              options.scene);
        loaded.light = baked->light;
    } else {
        apply(loaded.light, loaded.scene.extras);
    }
    apply(loaded.light, options);
    return loaded;
}

void add_camera_options(CLI::App& app, ViewOptions& options) {
    const std::string group = "View";
    app.add_option("--camera", options.camera, "camera of the scene, by node name")->group(group);
    app.add_option("--eye", options.eye, "x,y,z of a free camera")->group(group);
    app.add_option("--at", options.at, "x,y,z it looks at")->group(group);
    app.add_option("--fov", options.fov, "its vertical field of view in degrees (default 60)")->group(group);
    app.add_option("--size", options.size, "WxH in pixels")->group(group)->capture_default_str();
}

void add_view_options(CLI::App& app, ViewOptions& options, bool with_hour) {
    add_camera_options(app, options);
    const std::string group = "View";
    if (with_hour)
        app.add_option("--hour", options.hour, "H or HH:MM, local clock")->group(group)->capture_default_str();
    app.add_option("--show", options.show, "final, direct, indirect, irradiance, albedo, normal, depth, lightmap, ...")
        ->group(group)
        ->capture_default_str();
    app.add_option("--ev", options.ev, "exposure EV100, or auto")->group(group)->capture_default_str();
    app.add_option("--move", options.moves, "NODE=x,y,z[,yaw]: puts a node elsewhere; repeatable")
        ->group(group)
        ->allow_extra_args(false);
    app.add_option("--time", options.time, "seconds on the animations' clocks")->group(group)->capture_default_str();
}

void add_volume_mode(CLI::App& app, std::string& mode) {
    app.add_option("--volume-mode", mode, "where the volume lights what moves: auto | object | vertex | pixel")
        ->capture_default_str();
}

std::optional<double> parse_ev(const std::string& text) {
    if (text == "auto") return std::nullopt;
    return parse_number("--ev", text, -20, 40);
}

std::vector<NodeMove> parse_moves(const Scene& scene, const std::vector<std::string>& moves) {
    std::vector<NodeMove> parsed;
    for (const std::string& move : moves) parsed.push_back(parse_move(scene, move));
    return parsed;
}

double seconds_of(const ViewOptions& options) {
    check_range("--time", options.time, -kMaxAnimationTime, kMaxAnimationTime);
    return options.time;
}

void require_part(Layer layer, const LoadedScene& loaded, const std::string& light_file) {
    if (layer <= Layer::Depth) return;
    const std::string part = name(layer);
    if (!loaded.baked) throw UsageError("--show", "'" + part + "' is a part of a baked file; name one with --light");
    const bool there =
        (layer == Layer::Lightmap && loaded.baked->lightmap) || (layer == Layer::Volume && loaded.baked->volume);
    if (!there) throw Error(light_file, "has no " + part + " to --show; daylit info says why");
}

double target_error(const std::string& quality, const std::optional<double>& error) {
    if (error) {
        check_range("--error", *error, 0.001, 1.0);
        return *error;
    }
    if (quality == "preview") return 0.10;
    if (quality == "medium") return 0.03;
    if (quality == "high") return 0.01;
    throw UsageError("--quality", "'" + quality + "' is not one of preview, medium, high");
}

CLI::Option* add_seed(CLI::App& app, std::uint64_t& seed, const char* about) {
    const auto problem = [](const std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error == std::errc() && end == text.data() + text.size()) return {};
        return "'" + text + "' is not a whole number of 0 to 18446744073709551615";
    };
    return app.add_option("--seed", seed, about)->check(problem)->capture_default_str();
}

View view_from_options(const ViewOptions& options, const Scene& scene, const Pose& pose) {
    const bool free_camera = !options.eye.empty() || !options.at.empty();
    if (options.fov && !free_camera)
        throw UsageError("--fov", "is that of the camera of --eye and --at; a scene's camera has its own");
    if (!options.camera.empty()) {
        if (free_camera) throw UsageError("--camera", "give either --camera or --eye and --at");
        return camera_view(scene, pose, options.camera);
    }
    if (free_camera) {
        if (options.eye.empty() || options.at.empty()) throw UsageError("--eye", "--eye and --at go together");
        const double fov = options.fov.value_or(60.0);
        check_range("--fov", fov, 0.01, 179);
        const Vec3 eye = parse_place("--eye", options.eye), at = parse_place("--at", options.at);
        if (eye == at) throw Error("--at", "is the same point as --eye");
        return look_at(eye, at, float(fov * kDegree));
    }
    if (!scene.cameras.empty()) return camera_view(scene, pose, scene.cameras.front().name);
    return overview(bounds(world_mesh(scene, pose, Part::All)));
}

}  // namespace daylit
