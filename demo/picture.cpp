#include "demo/picture.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <future>

#include "engine/base/error.h"
#include "engine/base/exposure.h"
#include "engine/render/frame_plan.h"

namespace daylit {
namespace {

std::unique_ptr<GlContext> open_context(const std::string& name) {
    return name == "any" ? make_any_context() : make_context(parse_context_kind(name));
}

LoadedScene load_for(Layer layer, const PictureOptions& options) {
    LoadedScene loaded = load(options.scene, options.light);
    require_part(layer, loaded, options.light);
    return loaded;
}

/// Medians of each pass' time over several reports of the same frame.
FrameReport with_median_times(std::vector<FrameReport> reports) {
    FrameReport result = reports.back();
    for (std::size_t pass = 0; pass < result.passes.size(); ++pass)
        for (double PassReport::*time : {&PassReport::milliseconds, &PassReport::processor_milliseconds}) {
            std::vector<double> times;
            for (const FrameReport& report : reports) times.push_back(report.passes[pass].*time);
            std::nth_element(times.begin(), times.begin() + long(times.size() / 2), times.end());
            result.passes[pass].*time = times[times.size() / 2];
        }
    return result;
}

}  // namespace

void add_picture_options(CLI::App& app, PictureOptions& options, bool with_hour) {
    add_scene_options(app, options.scene);
    add_view_options(app, options.view, with_hour);
    const std::string group = "Picture";
    app.add_option("--light", options.light, "baked light, .daylit")->group(group);
    app.add_option("--context", options.context, "egl | osmesa | glfw | any")->group(group)->capture_default_str();
    add_volume_mode(app, options.volume_mode);
    app.add_option("--samples", options.samples_per_side,
                   "samples along each side of a pixel, 1 to 8; else 2, or 4 for a shot to .exr")
        ->group(group);
    app.add_option("--frames", options.frames, "draws it this often and reports median times of the passes")
        ->group(group)
        ->capture_default_str();
    app.add_flag("--no-culling", options.no_culling, "draws also what the view cannot see, to judge culling")
        ->group(group);
}

struct Photographer::State {
    explicit State(const PictureOptions& o)
        : options(o),
          layer(parse_layer(o.view.show)),
          volume_mode(parse_volume_mode(o.volume_mode)),
          ev(parse_ev(o.view.ev)),
          size(parse_size(o.view.size)),
          loaded(load_for(layer, o)),
          moves(parse_moves(loaded.scene, o.view.moves)),
          coming_light(std::async(
              std::launch::async,
              [this] { return LightModel(loaded.light, placed_lights(loaded.scene, pose_scene(loaded.scene))); })),
          context(open_context(o.context)),
          renderer(loaded.scene, loaded.baked ? &*loaded.baked : nullptr),
          light(coming_light.get()) {}

    PictureOptions options;
    Layer layer;
    VolumeMode volume_mode;
    std::optional<double> ev;
    Size size;
    LoadedScene loaded;
    std::vector<NodeMove> moves;
    std::future<LightModel> coming_light;  // its sky takes as long as the renderer's textures
    std::unique_ptr<GlContext> context;
    Renderer renderer;
    LightModel light;
    bool said_unbaked = false;
};

Photographer::Photographer(const PictureOptions& options) {
    const int samples = options.samples_per_side.value_or(kSamplesPerSide);
    if (samples < 1 || samples > 8) throw Error("--samples", "give 1 to 8 samples along a pixel's side");
    if (options.frames < 1 || options.frames > 1000) throw Error("--frames", "give 1 to 1000");
    state_ = std::make_unique<State>(options);
}

Photographer::~Photographer() = default;

const LoadedScene& Photographer::loaded() const {
    return state_->loaded;
}

std::string Photographer::driver() const {
    return state_->context->description();
}

Picture Photographer::take(double hour, double seconds) {
    State& s = *state_;
    const Pose pose = pose_scene(s.loaded.scene, seconds, s.moves);
    s.renderer.set_pose(pose);
    s.renderer.set_lighting(s.light.at(hour));
    FrameSettings frame;
    frame.view = view_from_options(s.options.view, s.loaded.scene, pose);
    frame.width = s.size.width;
    frame.height = s.size.height;
    frame.hour = hour;
    frame.show = s.layer;
    frame.volume_mode = s.volume_mode;
    frame.volume_view = s.layer == Layer::Volume;
    frame.ev = s.ev.value_or(0.0);  // metered below, over every pixel
    frame.samples_per_side = s.options.samples_per_side.value_or(kSamplesPerSide);
    frame.cull = !s.options.no_culling;
    frame.timings = s.options.frames > 1;

    Picture picture;
    std::vector<FrameReport> reports;
    for (int i = 0; i < s.options.frames; ++i) reports.push_back(s.renderer.draw(frame));
    picture.report = with_median_times(std::move(reports));
    picture.radiance = s.renderer.read_radiance();
    picture.ev = s.ev ? *s.ev : auto_ev(picture.radiance);
    if (!s.loaded.baked && !s.said_unbaked) {
        std::fprintf(stderr, "daylit: no baked light (--light), so indirect light is zero\n");
        s.said_unbaked = true;
    }
    return picture;
}

Image displayed(const Picture& picture, Layer layer) {
    if (!shown_as_is(layer)) return tonemap(picture.radiance, picture.ev);
    Image image = picture.radiance;
    for (Rgb& pixel : image.pixels) pixel = glm::clamp(pixel, Rgb(0.0f), Rgb(1.0f));
    return image;
}

void write_picture(const std::filesystem::path& path, const Picture& picture, Layer layer) {
    const bool linear = path.extension() == ".exr";
    write_image(path, linear ? picture.radiance : displayed(picture, layer));
}

}  // namespace daylit
