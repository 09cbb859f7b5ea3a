#pragma once
// Shadow maps of the suns: square cascades around the eye, each three times as wide as the one before, and the last one
// over the whole scene. They hang on the eye's place alone (snapped to a coarse grid of whole texels), so that turning
// the head redraws nothing and walking redraws a cascade now and then.
#include <array>
#include <span>
#include <vector>

#include "engine/render/draw_scene.h"
#include "engine/render/farthest_depth.h"
#include "engine/scene/sky.h"
#include "shaders/shared/frame_block.h"

namespace daylit {

/// Where the maps of one sun lie.
struct SunFit {
    glsl::SunBlock block;
    std::vector<Vec4> cascades;  // as FrameBlock::cascades
    float depth_range = 1.0f;    // metres
};

/// texels    along a map's side
/// nearest   half the side of the first cascade, metres
SunFit fit_sun(const Sun& sun, const Bounds& scene, const Vec3& eye, int texels, float nearest = 6.0f);

/// clip_from_world of one cascade: depth 0 at the highest caster, 1 at the lowest.
Mat4 cascade_matrix(const SunFit& fit, std::size_t cascade, int texels);

/// BLEND casters that one ray of light may pass: two panes of two faces and one more surface.
inline constexpr int kVeils = 5;

class SunShadow {
  public:
    /// Plans the maps for this frame; true when some of them must be drawn again.
    bool plan(std::span<const Sun> suns, const DrawScene& scene, const Vec3& eye, int texels);
    /// Draws what plan() found stale, at most once each.
    DrawCount draw(DrawScene& scene);

    int maps_drawn() const { return maps_drawn_; }  // by the last draw()
    int texels() const { return texels_; }
    /// Suns and cascades into the frame's block, and the textures to units 5 to 7.
    void use(glsl::FrameBlock& frame) const;

  private:
    void make_textures(const DrawScene& scene);
    void draw_range(DrawScene& scene, int layer);
    DrawCount draw_veils(DrawScene& scene, const Mat4& matrix, int layer);
    int layers() const;
    void read_farthest(int layer);
    bool any_may_reach(const std::array<Vec3, 3>& triangle, bool double_sided) const;
    /// Parts what stands into what some sun may reach and what surely lies in the dark.
    void split_triangles(DrawScene& scene) const;

    std::vector<SunFit> fits_, drawn_;
    std::vector<std::vector<bool>> stale_;  // by sun and cascade
    std::uint64_t drawn_version_ = 0;
    int texels_ = 0, maps_drawn_ = 0;
    int texture_layers_ = 0, texture_texels_ = 0;
    bool veiled_ = false;
    GlTexture depth_, plain_range_, range_, veils_, veil_depth_;
    std::vector<FarthestDepth> farthest_;  // by layer
    GlQuery veils_found_;
    GlFramebuffer framebuffer_;
};

}  // namespace daylit
