#pragma once
// Pictures of a scene through the renderer, off-screen; what `shot` and `day` share.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "demo/options.h"
#include "engine/gl/context.h"
#include "engine/render/renderer.h"

namespace CLI {
class App;
}

namespace daylit {

inline constexpr int kSamplesPerSide = 2;

struct PictureOptions {
    SceneOptions scene;
    ViewOptions view;
    std::string light;                    // .daylit file; empty: none
    std::string context = "any";          // egl, osmesa, glfw, any
    std::string volume_mode = "auto";     // auto, object, vertex, pixel
    std::optional<int> samples_per_side;  // of each pixel; not given: kSamplesPerSide
    int frames = 1;  // draws each picture this often; the last one is kept, the passes' times are medians
    bool no_culling = false;
};
void add_picture_options(CLI::App& app, PictureOptions& options, bool with_hour = true);

/// One drawn frame, not yet read back.
struct Picture {
    Image radiance;  // cd/m^2, or the layer's own unit
    FrameReport report;
    double ev = 0.0;  // given, or auto_ev() of the radiance, as `reference` does
};

/// A loaded scene with a context and a renderer. Its first picture says on stderr when there is no baked light.
class Photographer {
  public:
    explicit Photographer(const PictureOptions& options);
    ~Photographer();

    const LoadedScene& loaded() const;
    /// `seconds` on the animations' clocks.
    Picture take(double hour, double seconds);
    std::string driver() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// .exr: the values as they are. .png: as displayed.
void write_picture(const std::filesystem::path& path, const Picture& picture, Layer layer);

/// The picture as a display shows it, display-linear in [0,1].
Image displayed(const Picture& picture, Layer layer);

}  // namespace daylit
