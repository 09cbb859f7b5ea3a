#include "engine/render/sun_shadow.h"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>

#include "engine/gl/target.h"
#include "engine/render/sun_reach.h"

namespace daylit {
namespace {

constexpr int kSnapTexels = 64;  // cascades move by this many texels
constexpr float kWidening = 3.0f;

/// Panes are large and their edges mostly framed: a coarser map serves.
int veil_texels(int texels) { return std::min(texels / 2, 1024); }

int range_levels(int texels) { return mip_levels(texels / 4, texels / 4) - 2; }

}  // namespace

SunFit fit_sun(const Sun& sun, const Bounds& scene, const Vec3& eye, int texels, float nearest) {
    const Vec3 d = sun.direction;
    const Vec3 x = glm::normalize(glm::cross(std::abs(d.y) < 0.99f ? Vec3(0, 1, 0) : Vec3(0, 0, 1), d));
    const Vec3 y = glm::cross(d, x);

    Bounds box;  // of the scene, in shadow space with z towards the sun
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p(corner & 1 ? scene.max.x : scene.min.x, corner & 2 ? scene.max.y : scene.min.y,
                     corner & 4 ? scene.max.z : scene.min.z);
        box.add({glm::dot(x, p), glm::dot(y, p), glm::dot(d, p)});
    }
    const float margin = 1.0e-3f * (1.0f + box.max.z - box.min.z);

    SunFit fit;
    fit.depth_range = box.max.z - box.min.z + 2.0f * margin;
    fit.block.axis_x = Vec4(x, 0);
    fit.block.axis_y = Vec4(y, 0);
    fit.block.direction = Vec4(d, box.max.z + margin);
    fit.block.irradiance = Vec4(sun.irradiance, fit.depth_range);
    fit.block.radiance = Vec4(disc_radiance(sun), 0);

    const Vec2 center = Vec2(box.min + box.max) * 0.5f;
    const float whole = 1.01f * 0.5f * std::max(box.max.x - box.min.x, box.max.y - box.min.y) + margin;
    // A penumbra's kernel must not leave the map.
    const float reach = std::tan(float(kSunRadius)) * fit.depth_range;
    for (float half = nearest; half < 0.7f * whole && fit.cascades.size() + 1 < glsl::kMaxCascades; half *= kWidening) {
        const float texel = 2.0f * half / float(texels), step = texel * kSnapTexels;
        const Vec2 at = glm::round(Vec2(glm::dot(x, eye), glm::dot(y, eye)) / step) * step;
        fit.cascades.emplace_back(at, texel, half - std::min(reach + 2.0f * texel, 0.2f * half));
    }
    fit.cascades.emplace_back(center, 2.0f * whole / float(texels), whole);
    fit.block.radiance.w = float(fit.cascades.size());
    return fit;
}

Mat4 cascade_matrix(const SunFit& fit, std::size_t cascade, int texels) {
    const Vec4& c = fit.cascades[cascade];
    const float scale = 2.0f / (c.z * float(texels));
    const Vec3 x = Vec3(fit.block.axis_x) * scale, y = Vec3(fit.block.axis_y) * scale;
    const Vec3 z = -Vec3(fit.block.direction) / fit.depth_range;
    return Mat4(Vec4(x.x, y.x, z.x, 0), Vec4(x.y, y.y, z.y, 0), Vec4(x.z, y.z, z.z, 0),
                Vec4(-c.x * scale, -c.y * scale, fit.block.direction.w / fit.depth_range, 1));
}

int SunShadow::layers() const {
    std::size_t count = 0;
    for (const SunFit& fit : fits_) count += fit.cascades.size();
    return int(count);
}

bool SunShadow::plan(std::span<const Sun> suns, const DrawScene& scene, const Vec3& eye, int texels) {
    fits_.clear();
    stale_.clear();
    if (scene.box.empty()) return false;
    // Several suns share the memory of one.
    texels_ = suns.size() > 1 ? texels / 2 : texels;
    for (const Sun& sun : suns.first(std::min<std::size_t>(suns.size(), glsl::kMaxSuns)))
        fits_.push_back(fit_sun(sun, scene.box, eye, texels_));
    float first_layer = 0.0f;
    for (SunFit& fit : fits_) {
        fit.block.axis_x.w = first_layer;
        first_layer += float(fit.cascades.size());
    }

    bool any = false;
    const bool all = texture_texels_ != texels_ || texture_layers_ != layers() || drawn_.size() != fits_.size();
    for (std::size_t s = 0; s < fits_.size(); ++s) {
        stale_.emplace_back(fits_[s].cascades.size(), true);
        const bool same_sun = !all && fits_[s].block.direction == drawn_[s].block.direction &&
                              fits_[s].depth_range == drawn_[s].depth_range &&
                              fits_[s].cascades.size() == drawn_[s].cascades.size();
        for (std::size_t c = 0; c < fits_[s].cascades.size(); ++c) {
            stale_[s][c] = !(same_sun && fits_[s].cascades[c] == drawn_[s].cascades[c]) ||
                           scene.moved_in(frustum(cascade_matrix(fits_[s], c, texels_), false), drawn_version_);
            any |= stale_[s][c];
        }
    }
    return any;
}

void SunShadow::make_textures(const DrawScene& scene) {
    if (texture_texels_ == texels_ && texture_layers_ == layers()) return;
    texture_texels_ = texels_;
    texture_layers_ = layers();
    const TextureLook nearest{GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_NONE};
    const TextureLook mips{GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_NONE};
    depth_ = make_texture_array(GL_DEPTH_COMPONENT32F, texels_, texels_, texture_layers_, 1, nearest);
    const int levels = range_levels(texels_);
    plain_range_ = make_texture_array(GL_RG32F, texels_ / 4, texels_ / 4, texture_layers_, levels, mips);
    range_ = make_texture_array(GL_RG32F, texels_ / 4, texels_ / 4, texture_layers_, levels, mips);
    veiled_ = scene.any_veils;
    if (veiled_) {
        veils_ = make_texture_array(GL_RG32F, veil_texels(texels_), veil_texels(texels_), texture_layers_ * kVeils, 1, nearest);
        veil_depth_ = make_texture_2d(GL_DEPTH_COMPONENT32F, veil_texels(texels_), veil_texels(texels_));
        veils_found_ = make_query(GL_ANY_SAMPLES_PASSED);
    }
    framebuffer_ = make_framebuffer();
    farthest_.assign(std::size_t(texture_layers_), {});
}

void SunShadow::draw_range(DrawScene& scene, int layer) {
    glDisable(GL_DEPTH_TEST);
    const int levels = range_levels(texels_);
    const GLuint fbo = framebuffer_.get();
    const auto pass = [&](GLuint target, int level, GLuint source, int source_level, const char* define) {
        const int side = (texels_ / 4) >> level;
        glNamedFramebufferTextureLayer(fbo, GL_COLOR_ATTACHMENT0, target, level, layer);
        glViewport(0, 0, side, side);
        const Program& program = scene.programs.get("fullscreen.vert", "depth_range.frag",
                                                    define ? std::vector<std::string>{define} : std::vector<std::string>{});
        program.use();
        program.set("layer", layer);
        // Reading one level of the texture that is drawn to is defined only when sampling is held to that level.
        if (source == plain_range_.get()) {
            glTextureParameteri(source, GL_TEXTURE_BASE_LEVEL, source_level);
            glTextureParameteri(source, GL_TEXTURE_MAX_LEVEL, source_level);
        }
        bind_texture(0, source);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    };
    glNamedFramebufferTexture(fbo, GL_DEPTH_ATTACHMENT, 0, 0);
    glNamedFramebufferDrawBuffer(fbo, GL_COLOR_ATTACHMENT0);
    pass(plain_range_.get(), 0, depth_.get(), 0, "FROM_DEPTH");
    for (int level = 1; level < levels; ++level) pass(plain_range_.get(), level, plain_range_.get(), level - 1, nullptr);
    for (int level = 0; level < levels; ++level) pass(range_.get(), level, plain_range_.get(), level, "DILATE");
    glEnable(GL_DEPTH_TEST);
}

DrawCount SunShadow::draw_veils(DrawScene& scene, const Mat4& matrix, int layer) {
    DrawCount count;
    const GLuint fbo = framebuffer_.get();
    const float far = 1.0f, nothing[4] = {2.0f, 1.0f, 0.0f, 0.0f};  // beyond every receiver, letting all through
    glNamedFramebufferTexture(fbo, GL_DEPTH_ATTACHMENT, veil_depth_.get(), 0);
    glNamedFramebufferDrawBuffer(fbo, GL_COLOR_ATTACHMENT0);
    glViewport(0, 0, veil_texels(texels_), veil_texels(texels_));
    bind_texture(7, veils_.get());
    GLuint found = GL_TRUE;
    // A look-up goes no further than the first layer that holds nothing, so what lies behind that may stay as it is.
    for (int i = 0; i < kVeils && found; ++i) {
        glNamedFramebufferTextureLayer(fbo, GL_COLOR_ATTACHMENT0, veils_.get(), 0, layer * kVeils + i);
        glClearNamedFramebufferfv(fbo, GL_COLOR, 0, nothing);
        glClearNamedFramebufferfv(fbo, GL_DEPTH, 0, &far);
        glBeginQuery(GL_ANY_SAMPLES_PASSED, veils_found_.get());
        count.add(scene.draw_veils(matrix, frustum(matrix, false), i == 0 ? -1 : layer * kVeils + i - 1));
        glEndQuery(GL_ANY_SAMPLES_PASSED);
        glGetQueryObjectuiv(veils_found_.get(), GL_QUERY_RESULT, &found);
    }
    return count;
}

void SunShadow::read_farthest(int layer) {
    const int side = texels_ / 4;
    std::vector<Vec2> range(std::size_t(side) * std::size_t(side));
    glTextureParameteri(plain_range_.get(), GL_TEXTURE_BASE_LEVEL, 0);
    glGetTextureSubImage(plain_range_.get(), 0, 0, 0, layer, side, side, 1, GL_RG, GL_FLOAT,
                         GLsizei(range.size() * sizeof(Vec2)), range.data());
    std::vector<float> farthest(range.size());
    std::transform(range.begin(), range.end(), farthest.begin(), [](const Vec2& r) { return r.y; });
    farthest_[std::size_t(layer)] = FarthestDepth(side, std::move(farthest));
}

bool SunShadow::any_may_reach(const TriangleCorners& triangle, bool double_sided) const {
    for (const SunFit& fit : fits_) {
        const std::span maps(farthest_.data() + std::size_t(fit.block.axis_x.w), fit.cascades.size());
        if (may_reach(fit, maps, texels_, triangle, double_sided)) return true;
    }
    return false;
}

void SunShadow::split_triangles(DrawScene& scene) const {
    if (!scene.parts[0]) return scene.sun_split.reached.clear();
    const DrawMesh& mesh = scene.parts[0]->mesh();
    scene.sun_split.reached.assign(mesh.clusters.size(), 0u);
    std::vector<std::uint32_t> indices(mesh.indices.size());
    tbb::parallel_for(std::size_t(0), mesh.batches.size(), [&](std::size_t b) {
        const Batch& batch = mesh.batches[b];
        const bool double_sided = scene.material(batch).double_sided;
        for (std::uint32_t c = batch.first_cluster; c < batch.first_cluster + batch.cluster_count; ++c) {
            const Cluster& cluster = mesh.clusters[c];
            std::vector<std::uint32_t> dark;
            auto out = indices.begin() + long(cluster.first);
            for (auto i = mesh.indices.begin() + long(cluster.first), end = i + long(cluster.count); i != end; i += 3) {
                if (any_may_reach({mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]]}, double_sided))
                    out = std::copy(i, i + 3, out);
                else
                    dark.insert(dark.end(), i, i + 3);
            }
            scene.sun_split.reached[c] = cluster.count - std::uint32_t(dark.size());
            std::copy(dark.begin(), dark.end(), out);
        }
    });
    scene.sun_split.indices = make_buffer(indices);
}

DrawCount SunShadow::draw(DrawScene& scene) {
    DrawCount count;
    maps_drawn_ = 0;
    make_textures(scene);
    const GLuint fbo = framebuffer_.get();
    glBindFramebuffer(GL_FRAMEBUFFER, fbo);
    int layer = 0;
    for (std::size_t s = 0; s < fits_.size(); ++s)
        for (std::size_t c = 0; c < fits_[s].cascades.size(); ++c, ++layer) {
            if (!stale_[s][c]) continue;
            ++maps_drawn_;
            const Mat4 matrix = cascade_matrix(fits_[s], c, texels_);
            const Frustum seen = frustum(matrix, false);
            glNamedFramebufferTexture(fbo, GL_COLOR_ATTACHMENT0, 0, 0);
            glNamedFramebufferTextureLayer(fbo, GL_DEPTH_ATTACHMENT, depth_.get(), 0, layer);
            glNamedFramebufferDrawBuffer(fbo, GL_NONE);
            glViewport(0, 0, texels_, texels_);
            glDepthFunc(GL_LESS);
            const float far = 1.0f;
            glClearNamedFramebufferfv(fbo, GL_DEPTH, 0, &far);
            count.add(scene.draw_casters(matrix, seen));
            draw_range(scene, layer);
            read_farthest(layer);
            if (veiled_) count.add(draw_veils(scene, matrix, layer));
        }
    glDepthFunc(GL_GREATER);
    split_triangles(scene);
    drawn_ = fits_;
    drawn_version_ = scene.version;
    return count;
}

void SunShadow::use(glsl::FrameBlock& frame) const {
    for (std::size_t s = 0; s < fits_.size(); ++s) {
        frame.suns[s] = fits_[s].block;
        std::copy(fits_[s].cascades.begin(), fits_[s].cascades.end(), frame.cascades + s * glsl::kMaxCascades);
    }
    frame.counts.x = float(fits_.size());
    frame.counts.z = float(texels_);
    if (fits_.empty()) return;
    bind_texture(5, depth_.get());
    bind_texture(6, range_.get());
    if (veiled_) bind_texture(7, veils_.get());
}

}  // namespace daylit
