#include "engine/render/lamp_shadow.h"

#include <algorithm>
#include <cmath>

#include "engine/gl/target.h"

namespace daylit {
namespace {

int texels_for(std::size_t layers) {
    constexpr std::size_t kTexelBudget = std::size_t(24) << 20;
    int texels = 1024;
    while (texels > 128 && std::size_t(texels) * std::size_t(texels) * layers > kTexelBudget) texels /= 2;
    return texels;
}

}  // namespace

bool LampShadow::plan(std::span<const PlacedLight> lamps, const DrawScene& scene) {
    std::vector<PlacedLight> shining;
    std::size_t layers = 0;
    for (const PlacedLight& lamp : lamps)
        if (lamp.kind != LightKind::Directional && lamp.intensity != Rgb(0.0f)) shining.push_back(lamp);
    if (shining.size() > glsl::kMaxLamps) {  // the block's limit: the strongest stay
        std::stable_sort(shining.begin(), shining.end(), [](const PlacedLight& a, const PlacedLight& b) {
            return luminance(a.intensity) > luminance(b.intensity);
        });
        shining.resize(glsl::kMaxLamps);
    }
    for (const PlacedLight& lamp : shining) layers += fit_lamp(lamp, 1024).maps.size();
    texels_ = texels_for(layers);
    layers_ = int(layers);
    fits_.clear();
    float first_layer = 0.0f;
    for (const PlacedLight& lamp : shining) {
        fits_.push_back(fit_lamp(lamp, texels_));
        fits_.back().block.intensity.w = first_layer;
        fits_.back().moves = lamp.node >= 0 && scene.scene.nodes[std::size_t(lamp.node)].dynamic;
        first_layer += float(fits_.back().maps.size());
    }

    const bool all = texture_texels_ != texels_ || texture_layers_ != layers_ || drawn_.size() != fits_.size();
    stale_.clear();
    bool any = false;
    for (std::size_t i = 0; i < fits_.size(); ++i)
        for (const LampMap& map : fits_[i].maps) {
            stale_.push_back(all || !same_maps(fits_[i], drawn_[i]) ||
                             scene.moved_in(frustum(lamp_matrix(fits_[i], map), true), drawn_version_));
            any |= stale_.back();
        }
    return any;
}

DrawCount LampShadow::draw(DrawScene& scene) {
    DrawCount count;
    maps_drawn_ = 0;
    if (texture_texels_ != texels_ || texture_layers_ != layers_) {
        texture_texels_ = texels_;
        texture_layers_ = layers_;
        depth_ = make_texture_array(GL_DEPTH_COMPONENT32F, texels_, texels_, layers_, 1,
                                    {GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_NONE});
        framebuffer_ = make_framebuffer();
        glNamedFramebufferDrawBuffer(framebuffer_.get(), GL_NONE);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glViewport(0, 0, texels_, texels_);
    int layer = 0;
    for (const LampFit& fit : fits_)
        for (const LampMap& map : fit.maps) {
            const int at = layer++;
            if (!stale_[std::size_t(at)]) continue;
            ++maps_drawn_;
            const Mat4 matrix = lamp_matrix(fit, map);
            glNamedFramebufferTextureLayer(framebuffer_.get(), GL_DEPTH_ATTACHMENT, depth_.get(), 0, at);
            const float far = 0.0f;
            glClearNamedFramebufferfv(framebuffer_.get(), GL_DEPTH, 0, &far);
            count.add(scene.draw_casters(matrix, frustum(matrix, true)));
        }
    scene.every_lamp = {};
    for (std::size_t i = 0; i < fits_.size(); ++i) scene.every_lamp[i / 32] |= 1u << (i % 32);
    lit_clusters_.find(scene, fits_, texels_);
    drawn_ = fits_;
    drawn_version_ = scene.version;
    return count;
}

bool LampShadow::any_spots() const {
    return std::any_of(fits_.begin(), fits_.end(), [](const LampFit& fit) { return fit.block.axis_x.w > -1.5f; });
}

void LampShadow::use(glsl::FrameBlock& frame) {
    frame.counts.y = float(fits_.size());
    frame.counts.w = float(texels_);
    if (fits_.empty()) return;
    if (!block_) block_ = make_buffer(std::vector<glsl::LampsBlock>(1), GL_DYNAMIC_STORAGE_BIT);
    std::vector<glsl::LampBlock> lamps;
    for (const LampFit& fit : fits_) lamps.push_back(fit.block);
    glNamedBufferSubData(block_.get(), 0, GLsizeiptr(lamps.size() * sizeof lamps[0]), lamps.data());
    bind_texture(8, depth_.get());
    glBindBufferBase(GL_UNIFORM_BUFFER, 2, block_.get());
}

}  // namespace daylit
