#include "engine/render/display.h"

#include <algorithm>

#include "engine/base/exposure.h"
#include "engine/gl/target.h"
#include "engine/render/frame_plan.h"

namespace daylit {
namespace {

constexpr std::uint16_t kNoCluster = 65535;

}  // namespace

void CameraTarget::resize(int width, int height, int samples) {
    if (width == width_ && height == height_ && samples == samples_) return;
    width_ = width;
    height_ = height;
    samples_ = samples;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (std::max(width, height) * samples > largest)
        throw Error("--size", std::to_string(width) + "x" + std::to_string(height) + " with " +
                                  std::to_string(samples * samples) + " samples a pixel is more than this driver's " +
                                  std::to_string(largest) + " pixels a side; ask for a smaller picture");
    light_ = make_texture_2d(GL_RGBA32F, width * samples, height * samples);
    depth_ = make_texture_2d(GL_DEPTH_COMPONENT32F, width * samples, height * samples);
    framebuffer_ = make_framebuffer({light_.get()}, depth_.get());
    clusters_ = GlTexture();
    pixels_ = GlTexture();
    pixels_framebuffer_ = GlFramebuffer();
    if (samples > 1) pixels_ = make_texture_2d(GL_RGBA32F, width, height);
    pixels_framebuffer_ = make_framebuffer({pixels()});
    grid_width_ = std::min(width, 160);
    grid_height_ = std::min(height, 90);
    grid_ = make_texture_2d(GL_RGBA32F, grid_width_, grid_height_);
    grid_framebuffer_ = make_framebuffer({grid_.get()});
}

void CameraTarget::bind_and_clear() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glViewport(0, 0, width_ * samples_, height_ * samples_);
    const float black[4] = {0, 0, 0, 0}, far = 0.0f;
    glClearNamedFramebufferfv(framebuffer_.get(), GL_COLOR, 0, black);
    glClearNamedFramebufferfv(framebuffer_.get(), GL_DEPTH, 0, &far);
}

void CameraTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
}

void CameraTarget::bind_clusters() {
    if (!clusters_.get()) {
        const TextureLook nearest{GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_NONE};
        clusters_ = make_texture_2d(GL_R16UI, width_ * samples_, height_ * samples_, 1, nearest);
        clusters_framebuffer_ = make_framebuffer({clusters_.get()}, depth_.get());
    }
    glBindFramebuffer(GL_FRAMEBUFFER, clusters_framebuffer_.get());
    const GLuint none[4] = {kNoCluster, 0, 0, 0};
    glClearNamedFramebufferuiv(clusters_framebuffer_.get(), GL_COLOR, 0, none);
}

std::vector<bool> CameraTarget::seen_clusters() const {
    std::vector<std::uint16_t> numbers(std::size_t(width_ * samples_) * std::size_t(height_ * samples_));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(clusters_.get(), 0, GL_RED_INTEGER, GL_UNSIGNED_SHORT, GLsizei(2 * numbers.size()),
                      numbers.data());
    std::vector<bool> seen(kNoCluster + 1);
    std::uint16_t last = kNoCluster;
    for (const std::uint16_t number : numbers) {
        if (number == last) continue;
        seen[number] = true;
        last = number;
    }
    seen[kNoCluster] = true;  // one that has this number cannot be told from none
    return seen;
}

void CameraTarget::resolve(Programs& programs) const {
    glBindFramebuffer(GL_FRAMEBUFFER, pixels_framebuffer_.get());
    glViewport(0, 0, width_, height_);
    const Program& program = programs.get("fullscreen.vert", "resolve.frag");
    program.use();
    program.set("samples_per_side", samples_);
    glBindTextureUnit(0, light_.get());
    glBindSampler(0, 0);
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

Image CameraTarget::read() const { return read_texture(pixels(), width_, height_); }

double CameraTarget::meter() {
    glBlitNamedFramebuffer(pixels_framebuffer_.get(), grid_framebuffer_.get(), 0, 0, width_, height_, 0, 0, grid_width_,
                           grid_height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return auto_ev(read_texture(grid_.get(), grid_width_, grid_height_));
}

void draw_display(const CameraTarget& target, Programs& programs, Layer layer, double ev, GLuint framebuffer, int width,
                  int height, bool coded) {
    std::vector<std::string> defines;
    if (shown_as_is(layer)) defines.push_back("AS_IS");
    if (coded) defines.push_back("ENCODE");
    const Program& program = programs.get("fullscreen.vert", "tonemap.frag", defines);
    program.use();
    program.set("exposure", shown_as_is(layer) ? 1.0 : exposure_from_ev(ev));
    glBindTextureUnit(0, target.pixels());
    glBindSampler(0, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    glDisable(GL_DEPTH_TEST);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace daylit
