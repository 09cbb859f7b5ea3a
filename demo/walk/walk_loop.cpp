#include "demo/walk/walk_loop.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "demo/parse.h"
#include "demo/walk/panel.h"
#include "demo/walk/sky_worker.h"
#include "demo/walk/window.h"
#include "engine/base/error.h"
#include "engine/render/frame_plan.h"
#include "engine/render/renderer.h"

namespace daylit {
namespace {

constexpr double kWaitForEvents = 0.25;  // seconds
constexpr double kWaitForSky = 0.02;
constexpr double kSkyMinutes = 1.0;          // the sky is worked out again when the hour has moved this far
constexpr float kAdaptationSeconds = 0.35f;  // of the eye to another brightness
constexpr float kSettledEv = 0.01f;

/// koldinghus-0730-1.png: the first number that is free in the working folder.
std::filesystem::path free_picture_path(const Scene& scene, double hour) {
    std::string clock = clock_text(hour);
    clock.erase(clock.find(':'), 1);
    for (int i = 1;; ++i) {
        const std::filesystem::path path = std::filesystem::current_path() / (scene.path.stem().string() + "-" + clock +
                                                                              "-" + std::to_string(i) + ".png");
        if (!std::filesystem::exists(path)) return path;
    }
}

class Walk {
  public:
    Walk(const LoadedScene& loaded, const WalkStart& start)
        : loaded_(loaded),
          state_(start.state),
          moves_(start.moves),
          animation_seconds_(start.seconds),
          collider_(world_mesh(loaded.scene, pose(), Part::Static)),
          walker_(collider_, state_.gaze.eye),
          worker_(placed_lights(loaded.scene, pose())),
          window_(start.size.width, start.size.height, title(), state_),
          renderer_(loaded.scene, loaded.baked ? &*loaded.baked : nullptr) {
        renderer_.set_pose(pose());
        worker_.request(state_.light, state_.hour);
        take_sky(worker_.wait());
        if (!model_) throw Error(state_.message);
    }

    void run() {
        auto before = std::chrono::steady_clock::now();
        while (!state_.quit) {
            window_.poll(idle_ ? (worker_.busy() ? kWaitForSky : kWaitForEvents) : 0.0);
            const auto now = std::chrono::steady_clock::now();
            // Time slept through does not count: nothing was moving.
            const float seconds = idle_ ? 0.0f : std::chrono::duration<float>(now - before).count();
            before = now;
            frame(seconds);
        }
    }

  private:
    Pose pose() const { return pose_scene(loaded_.scene, animation_seconds_, moves_); }

    std::string title() const {
        return loaded_.scene.path.filename().string() + " " + clock_text(state_.hour) + " - daylit";
    }

    void frame(float seconds) {
        move(seconds);
        fulfil_wishes();
        pass_time(seconds);
        update_light();
        int width = 0, height = 0;
        window_.size(width, height);
        const bool visible = width > 0 && height > 0;
        const bool wanted = std::exchange(redraw_, false) || window_.stirred();
        if (visible && wanted) draw(width, height, seconds);
        // A picture that stays as it is is not drawn again; a minimised walk stands still.
        idle_ = !visible || (!wanted && !redraw_);
    }

    void move(float seconds) {
        const Vec3 eye = walker_.eye();
        walker_.advance(window_.steering(seconds), seconds);
        state_.gaze.eye = walker_.eye();
        state_.flying = walker_.flying();
        if (eye != state_.gaze.eye) redraw_ = true;
    }

    void fulfil_wishes() {
        if (std::exchange(state_.toggle_flight, false)) walker_.fly(!walker_.flying());
        if (const auto number = std::exchange(state_.go_to, std::nullopt)) go_to(*number);
        if (std::exchange(state_.add_bookmark, false)) add_bookmark();
        if (std::exchange(state_.reload_shaders, false)) reload_shaders();
        if (state_.screenshot) redraw_ = true;  // saved once drawn: the window may have changed meanwhile
    }

    void go_to(std::size_t number) {
        if (number >= state_.bookmarks.size()) return;
        state_.gaze = state_.bookmarks[number].gaze;
        walker_.place(state_.gaze.eye);
        state_.gaze.eye = walker_.eye();
        state_.message = state_.bookmarks[number].name;
        redraw_ = true;
    }

    void add_bookmark() {
        const std::string name = "place " + std::to_string(state_.bookmarks.size() + 1);
        state_.bookmarks.push_back({name, state_.gaze});
        state_.message = "kept as " + name;
        std::printf("%s: %s\n", name.c_str(), shot_options(state_.gaze).c_str());
        std::fflush(stdout);
    }

    void reload_shaders() {
        const std::string log = renderer_.reload_shaders();
        state_.message = log.empty() ? "shaders are up to date" : log;
        if (!log.empty()) std::fprintf(stderr, "%s\n", log.c_str());
        redraw_ = true;
    }

    void save_picture() {
        try {
            const std::filesystem::path path = free_picture_path(loaded_.scene, state_.hour);
            write_image(path, renderer_.read_display());
            state_.message = "saved " + path.filename().string();
            std::printf("%s\n", path.c_str());
            std::fflush(stdout);
        } catch (const Error& error) {
            state_.message = error.what();
            std::fprintf(stderr, "daylit: %s\n", error.what());
        }
    }

    void pass_time(float seconds) {
        if (state_.playing) {
            state_.hour = wrapped_hour(state_.hour + double(state_.hours_per_second * seconds));
            redraw_ = true;
        }
        if (state_.animate && !loaded_.scene.animations.empty()) {
            animation_seconds_ += double(seconds);
            renderer_.set_pose(pose());
            redraw_ = true;
        }
        window_.set_title(title());
    }

    // The suns move at once; the sky follows as fast as it can be worked out.
    void update_light() {
        const double minutes = std::abs(state_.hour - asked_hour_) * 60;
        if (minutes >= kSkyMinutes || !(state_.light == asked_light_)) ask_for_sky();
        if (auto result = worker_.take()) take_sky(std::move(*result));
        if (state_.hour != sun_hour_) move_suns();
    }

    void ask_for_sky() {
        asked_hour_ = state_.hour;
        asked_light_ = state_.light;
        worker_.request(asked_light_, asked_hour_);
    }

    void take_sky(SkyWorker::Result result) {
        if (!result.error.empty()) {
            state_.message = result.error;
            return;
        }
        model_ = std::move(result.model);
        lighting_ = std::move(result.lighting);
        move_suns();
    }

    void move_suns() {
        sun_hour_ = state_.hour;
        lighting_.suns = model_->suns(sun_hour_);
        renderer_.set_lighting(lighting_);
        redraw_ = true;
    }

    void draw(int width, int height, float seconds) {
        const auto start = std::chrono::steady_clock::now();
        FrameSettings settings;
        settings.view = view_from_gaze(state_.gaze);
        settings.width = width;
        settings.height = height;
        settings.hour = state_.hour;
        settings.show = state_.show;
        settings.volume_view = state_.volume_view;
        settings.volume_mode = state_.volume_mode;
        settings.timings = state_.panel && state_.pass_times;
        const bool adapting = state_.auto_exposure && shows_radiance(state_.show);
        // The first frame, and layers that are not light, are exposed as the renderer finds best.
        if (drawn_ && shows_radiance(state_.show)) settings.ev = double(state_.ev - (adapting ? state_.compensation : 0.0f));
        settings.meter = adapting;
        report_ = renderer_.draw(settings);
        if (adapting) adapt(drawn_ ? seconds : -1.0f);
        drawn_ = true;
        renderer_.present(0, width, height);
        if (std::exchange(state_.screenshot, false)) save_picture();
        draw_panels();
        window_.end_panel_and_show();
        frame_milliseconds_ =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }

    /// seconds < 0: at once.
    void adapt(float seconds) {
        const float share = seconds < 0 ? 1.0f : 1.0f - std::exp(-seconds / kAdaptationSeconds);
        state_.ev += (float(report_.metered_ev) - state_.ev) * share;
        if (std::abs(float(report_.metered_ev) - state_.ev) > kSettledEv) redraw_ = true;
    }

    void draw_panels() {
        window_.begin_panel();
        const PanelFacts facts{.scene = &loaded_.scene,
                               .baked = loaded_.baked ? &*loaded_.baked : nullptr,
                               .frame = &report_,
                               .frame_milliseconds = frame_milliseconds_,
                               .mouse_captured = window_.mouse_captured()};
        if (state_.panel) draw_panel(state_, facts);
        if (state_.help) draw_help(state_);
    }

    const LoadedScene& loaded_;
    WalkState state_;
    std::vector<NodeMove> moves_;
    double animation_seconds_;
    Collider collider_;
    Walker walker_;
    SkyWorker worker_;
    WalkWindow window_;  // owns the context: before everything that owns GL objects
    Renderer renderer_;
    std::shared_ptr<const LightModel> model_;
    Lighting lighting_;
    LightSettings asked_light_;
    double asked_hour_ = -1000, sun_hour_ = -1000;
    FrameReport report_;
    double frame_milliseconds_ = 0;
    bool drawn_ = false, redraw_ = true, idle_ = false;
};

}  // namespace

void walk_loop(const LoadedScene& loaded, const WalkStart& start) {
    Walk(loaded, start).run();
}

}  // namespace daylit
