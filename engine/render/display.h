#pragma once
// Targets of the camera, and the way from their radiance to a display.
#include "engine/base/image.h"
#include "engine/render/programs.h"
#include "engine/scene/layer.h"

namespace daylit {

/// Linear RGBA32F: the sun's disc has 1.5e9 cd/m^2, far above what half floats hold.
class CameraTarget {
  public:
    /// Samples per side of a pixel; makes textures only when something changed.
    void resize(int width, int height, int samples_per_side);
    int width() const { return width_; }
    int height() const { return height_; }
    int samples_per_side() const { return samples_; }

    void bind_and_clear() const;
    /// Numbers of clusters in place of light, over the same depth.
    void bind_clusters();
    void bind() const;
    /// Which numbers some pixel has.
    std::vector<bool> seen_clusters() const;
    /// From samples to pixels.
    void resolve(Programs& programs) const;
    /// Pixels, after resolve() where there are several samples.
    GLuint pixels() const { return samples_ > 1 ? pixels_.get() : light_.get(); }
    Image read() const;

    /// EV of auto_ev() over a grid of at most 160 x 90 of the pixels: a tenth of a stop from that of all of them.
    double meter();

  private:
    int width_ = 0, height_ = 0, samples_ = 0;
    GlTexture light_, depth_, clusters_, pixels_, grid_;
    GlFramebuffer framebuffer_, clusters_framebuffer_, pixels_framebuffer_, grid_framebuffer_;
    int grid_width_ = 0, grid_height_ = 0;
};

/// Draws the target's pixels, as displayed, over a width x height framebuffer; coded: to sRGB.
void draw_display(const CameraTarget& target, Programs& programs, Layer layer, double ev, GLuint framebuffer, int width,
                  int height, bool coded);

}  // namespace daylit
