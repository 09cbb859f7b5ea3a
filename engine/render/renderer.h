#pragma once
// One frame: shadow maps, opaque surfaces, sky, blended surfaces, exposure and display. Needs a current GL 4.5 context.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/baked/baked_file.h"
#include "engine/baked/volume_mode.h"
#include "engine/scene/layer.h"
#include "engine/scene/pose.h"
#include "engine/scene/scene.h"
#include "engine/scene/sky.h"

namespace daylit {

struct FrameSettings {
    View view;
    int width = 1280, height = 720;
    double hour = 12.0;  // for the baked light's weights
    Layer show = Layer::Final;
    VolumeMode volume_mode = VolumeMode::Auto;  // for what moves; blended surfaces are lit per vertex in any case
    bool volume_view = false;  // in layers of baked light: the volume's samples as spheres, its cells as lines
    std::optional<double> ev;  // EV100; none: auto exposure
    bool meter = false;        // fill FrameReport::metered_ev though ev is given (the walk's eye adapts slowly to it)
    int samples_per_side = 1;  // of each pixel, box-filtered; 2 and more also fetch textures and shadows more finely
    bool cull = true;      // false draws also what the view cannot see, to judge what culling saves
    bool timings = false;  // glFinish around every pass, fills PassReport::milliseconds
};

struct PassReport {
    std::string name;
    bool ran = false;
    std::string why;  // the condition that made it run or skipped it
    double milliseconds = 0.0;
    double processor_milliseconds = 0.0;  // of all threads of the process; with a software driver the work itself,
                                          // also while other programs compete for the cores
    int draws = 0;
    long triangles = 0;
};

struct FrameReport {
    std::vector<PassReport> passes;
    int objects_drawn = 0, objects_culled = 0;
    double ev = 0.0;          // used
    double metered_ev = 0.0;  // what auto exposure chooses for this picture; filled when ev is none or meter is set
};

class Renderer {
  public:
    /// baked may be null: indirect light is then zero. Scene and baked must outlive the renderer.
    Renderer(const Scene& scene, const Baked* baked);
    ~Renderer();

    /// Sun, sky. Uploads only what changed; a still sun costs nothing.
    void set_lighting(const Lighting& lighting);
    /// Moves dynamic nodes (and everything else whose matrices changed).
    void set_pose(const Pose& pose);

    /// Draws into an internal linear RGBA32F target (kept until the next draw).
    FrameReport draw(const FrameSettings& frame);
    /// Scene-referred radiance (or the layer's own unit) of the last draw, row 0 on top.
    Image read_radiance() const;
    /// Exposes, tone-maps and codes the last draw to sRGB into a framebuffer (0: the window).
    void present(unsigned framebuffer, int width, int height);
    /// The last draw as displayed, display-linear in [0,1]; what present() shows, to 8 bits.
    Image read_display();

    /// Recompiles shaders whose files changed; on an error keeps the old programs and returns the log.
    std::string reload_shaders();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace daylit
