#pragma once
// What the keys and the panel change, as plain data; the loop acts on it once a frame.
#include <optional>
#include <string>
#include <vector>

#include "demo/walk/gaze.h"
#include "engine/baked/volume_mode.h"
#include "engine/scene/layer.h"
#include "engine/scene/sky.h"

namespace daylit {

struct WalkState {
    // Time of day
    double hour = 12.0;
    bool playing = false;
    float hours_per_second = 0.5f;
    LightSettings light;

    // What is shown
    Layer show = Layer::Final;
    bool volume_view = false;  // the volume's samples and cells
    VolumeMode volume_mode = VolumeMode::Auto;  // of what moves
    bool auto_exposure = true;
    float ev = 12.0f;           // EV100 of this frame: adapting, or as set by hand
    float compensation = 0.0f;  // stops brighter than metered, auto exposure only
    bool animate = true;

    // The camera
    Gaze gaze;
    bool flying = false;
    std::vector<Bookmark> bookmarks;  // the scene's cameras, then the walker's own

    // The window
    bool panel = true;
    Vec2 panel_size = Vec2(0.0f);  // what it covers of the upper left corner, as last drawn
    bool help = false;
    bool pass_times = false;  // the panel's table is open, so passes are timed
    std::string message;      // last thing that happened, one line or a shader log

    // Wishes, fulfilled and cleared by the loop
    std::optional<std::size_t> go_to;
    bool add_bookmark = false;
    bool screenshot = false;
    bool reload_shaders = false;
    bool toggle_flight = false;
    bool jump = false;
    bool quit = false;
};

/// Any real hour to [0,24).
double wrapped_hour(double hour);

}  // namespace daylit
