#pragma once
// Materials on the GPU: factors in one buffer, textures with mipmaps, samplers, and the shader features each one needs.
#include <map>
#include <string>
#include <vector>

#include "engine/gl/owners.h"
#include "engine/scene/scene.h"

namespace daylit {

/// How a material takes part in a frame.
enum class Coverage { Opaque, Mask, Through };  // Through: BLEND and glass, drawn after the sky from back to front

Coverage coverage(const Material& material);
/// BLEND dims light on its way; glass does not let it straight through, so it blocks (its light is a caustic).
bool veils(const Material& material);

/// The #defines of shaders/README.md for this material.
std::vector<std::string> surface_defines(const Material& material, bool vertex_colors);
/// Those that its coverage alone needs, for shadow maps and the depth pre-pass.
std::vector<std::string> coverage_defines(const Material& material, bool vertex_colors);

class Materials {
  public:
    /// used   the materials that some triangle has; textures of the others are not uploaded
    Materials(const Scene& scene, const std::vector<bool>& used);

    /// Factors to uniform block 1 and textures to units 0 to 3 and 12 to 14.
    void bind(std::uint32_t material) const;
    /// Only what coverage_defines() read.
    void bind_coverage(std::uint32_t material) const;
    /// Fine: blended mipmap levels and anisotropic filtering, for pictures. Otherwise the nearest level alone, for frames:
    /// half the texels to fetch, which is what a frame of a software driver mostly costs.
    void set_fine(bool fine);

    /// Share of their light that emitters lit in the evening give; 1 at first.
    void set_evening(float evening);

    std::size_t texture_bytes() const { return texture_bytes_; }

  private:
    void upload_textures(const std::vector<bool>& used);
    void bind_texture(GLuint unit, const TextureRef& ref, bool srgb) const;

    const Scene& scene_;
    GlBuffer blocks_;
    GLintptr stride_ = 0;
    std::map<std::pair<int, bool>, GlTexture> textures_;  // (image, sRGB)
    std::vector<GlSampler> samplers_;                     // one per Scene::textures
    std::size_t texture_bytes_ = 0;
    float largest_anisotropy_ = 1.0f;
    float evening_ = 1.0f;
    bool fine_ = true;
};

}  // namespace daylit
