#include "engine/render/lamp_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/gl/target.h"

namespace daylit {
namespace {

constexpr float kWidestSpot = 1.05f;  // radians; wider cones get a cube

// As cube_face() in shaders/lamps.glsl.
constexpr Vec3 kFaceZ[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
constexpr Vec3 kFaceX[6] = {{0, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}};

int texels_for(std::size_t layers) {
    constexpr std::size_t kTexelBudget = std::size_t(24) << 20;
    int texels = 1024;
    while (texels > 128 && std::size_t(texels) * std::size_t(texels) * layers > kTexelBudget) texels /= 2;
    return texels;
}

/// The same maps: all but how bright it shines.
bool same(const LampFit& a, const LampFit& b) {
    glsl::LampBlock block = a.block;
    block.intensity = Vec4(Vec3(b.block.intensity), block.intensity.w);
    return !std::memcmp(&block, &b.block, sizeof block);
}

}  // namespace

LampFit fit_lamp(const PlacedLight& lamp, std::size_t number, int texels) {
    const bool spot = lamp.kind == LightKind::Spot;
    const float outer = spot ? std::acos(glm::clamp(lamp.cos_outer, -1.0f, 1.0f)) : float(kPi);
    const bool cube = outer > kWidestSpot;
    const Vec3 z = lamp.direction;
    const Vec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.99f ? Vec3(0, 1, 0) : Vec3(0, 0, 1), z));
    const float span = 1.0f + glsl::kLampBorder / float(texels);
    LampFit fit{};
    fit.tan_half = (cube ? 1.0f : std::tan(outer)) * span;
    fit.block.position = Vec4(lamp.position, lamp.range > 0.0f ? 1.0f / std::pow(lamp.range, 4.0f) : 0.0f);
    fit.block.intensity = Vec4(lamp.intensity, 0.0f);
    fit.block.direction = Vec4(z, 1.0f / std::max(lamp.cos_inner - lamp.cos_outer, 1.0e-4f));
    fit.block.axis_x = Vec4(x, spot ? lamp.cos_outer : -2.0f);
    fit.block.map = Vec4(cube ? 0.0f : fit.tan_half, 0.0f, 0.0f, 0.0f);
    if (!cube) fit.maps.push_back({number, x, z});
    for (int face = 0; cube && face < 6; ++face) fit.maps.push_back({number, kFaceX[face], kFaceZ[face]});
    return fit;
}

Mat4 lamp_matrix(const LampFit& fit, const LampMap& map) {
    const Vec3 p = Vec3(fit.block.position);
    const Vec3 x = map.x / fit.tan_half, y = glm::cross(map.z, map.x) / fit.tan_half;
    return Mat4(Vec4(x.x, y.x, 0, map.z.x), Vec4(x.y, y.y, 0, map.z.y), Vec4(x.z, y.z, 0, map.z.z),
                Vec4(-glm::dot(x, p), -glm::dot(y, p), glsl::kLampNear, -glm::dot(map.z, p)));
}

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
    for (const PlacedLight& lamp : shining) layers += fit_lamp(lamp, 0, 1024).maps.size();
    texels_ = texels_for(layers);
    layers_ = int(layers);
    fits_.clear();
    float first_layer = 0.0f;
    for (const PlacedLight& lamp : shining) {
        fits_.push_back(fit_lamp(lamp, fits_.size(), texels_));
        fits_.back().block.intensity.w = first_layer;
        fits_.back().moves = lamp.node >= 0 && scene.scene.nodes[std::size_t(lamp.node)].dynamic;
        first_layer += float(fits_.back().maps.size());
    }

    const bool all = texture_texels_ != texels_ || texture_layers_ != layers_ || drawn_.size() != fits_.size();
    stale_.clear();
    bool any = false;
    for (std::size_t i = 0; i < fits_.size(); ++i)
        for (const LampMap& map : fits_[i].maps) {
            stale_.push_back(all || !same(fits_[i], drawn_[i]) ||
                             scene.moved_in(frustum(lamp_matrix(fits_[i], map), true), drawn_version_));
            any |= stale_.back();
        }
    return any;
}

void LampShadow::find_lit_clusters(DrawScene& scene) {
    // A number of a cluster is known modulo 2^16 only.
    const std::size_t clusters = scene.parts[0] ? scene.parts[0]->mesh().clusters.size() : 0;
    if (clusters >= 65535) return scene.lamp_bits.clear();
    const bool all = lit_version_ != scene.standing_version || scene.lamp_bits.size() != clusters || lit_.size() != fits_.size();
    if (all) scene.lamp_bits.assign(clusters, LampBits{});
    constexpr int kSide = 512;
    const GlTexture numbers = make_texture_2d(GL_R16UI, kSide, kSide, 1, {GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_NONE});
    const GlTexture depth = make_texture_2d(GL_DEPTH_COMPONENT32F, kSide, kSide);
    const GlFramebuffer framebuffer = make_framebuffer({numbers.get()}, depth.get());
    std::vector<std::uint16_t> seen(std::size_t(kSide) * kSide);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
    glViewport(0, 0, kSide, kSide);
    for (std::size_t i = 0; i < fits_.size(); ++i) {
        if (!all && same(fits_[i], lit_[i])) continue;
        const std::size_t word = i / 32;
        const std::uint32_t bit = 1u << (i % 32);
        for (LampBits& bits : scene.lamp_bits) bits[word] = fits_[i].moves ? bits[word] | bit : bits[word] & ~bit;
        if (fits_[i].moves) continue;  // it would have to be asked again every frame
        for (const LampMap& map : fits_[i].maps) {
            const GLuint nothing[4] = {65535, 0, 0, 0};
            const float far = 0.0f;
            glClearNamedFramebufferuiv(framebuffer.get(), GL_COLOR, 0, nothing);
            glClearNamedFramebufferfv(framebuffer.get(), GL_DEPTH, 0, &far);
            const Mat4 matrix = lamp_matrix(fits_[i], map);
            scene.draw_clusters(matrix, frustum(matrix, true));
            glPixelStorei(GL_PACK_ALIGNMENT, 1);
            glGetTextureImage(numbers.get(), 0, GL_RED_INTEGER, GL_UNSIGNED_SHORT, GLsizei(seen.size() * 2), seen.data());
            for (const std::uint16_t cluster : seen)
                if (cluster < clusters) scene.lamp_bits[cluster][word] |= bit;
        }
    }
    lit_ = fits_;
    lit_version_ = scene.standing_version;
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
    find_lit_clusters(scene);
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
