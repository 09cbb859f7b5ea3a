#include "engine/render/baked_light.h"

#include <algorithm>

#include "engine/gl/target.h"

namespace daylit {

BakedLight::BakedLight(const DayLightmap& lightmap)
    : basis_(lightmap.basis), width_(lightmap.width), height_(lightmap.height) {
    GLint largest = 0, layers = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    if (width_ > largest || height_ > largest || basis_.components > layers)
        throw Error("lightmap", std::to_string(width_) + "x" + std::to_string(height_) + " with " +
                                    std::to_string(basis_.components) + " components is more than this driver's " +
                                    std::to_string(largest) + " texels or " + std::to_string(layers) +
                                    " layers; bake with a larger --error");
    const TextureLook nearest{GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_NONE};
    components_ = make_texture_array(GL_RGB16F, width_, height_, std::max(basis_.components, 1), 1, nearest);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(components_.get(), 0, 0, 0, 0, width_, height_, basis_.components, GL_RGB, GL_HALF_FLOAT,
                        lightmap.components.data());
    irradiance_ = make_texture_2d(GL_RGBA16F, width_, height_);
    framebuffer_ = make_framebuffer({irradiance_.get()});
    weights_buffer_ = make_buffer(std::vector<float>(std::size_t(std::max(basis_.components, 1))),
                                  GL_DYNAMIC_STORAGE_BIT);
}

bool BakedLight::stale(double hour) const { return !weights_ || basis_.weights(hour) != *weights_; }

void BakedLight::set_hour(double hour, Programs& programs) {
    if (!stale(hour)) return;
    weights_ = basis_.weights(hour);
    glNamedBufferSubData(weights_buffer_.get(), 0, GLsizeiptr(weights_->size() * sizeof(float)), weights_->data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, weights_buffer_.get());
    glBindTextureUnit(0, components_.get());
    glBindSampler(0, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glViewport(0, 0, width_, height_);
    glDisable(GL_DEPTH_TEST);
    programs.get("fullscreen.vert", "relight.frag").use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
}

}  // namespace daylit
