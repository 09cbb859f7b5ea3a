#pragma once
// Textures and materials evaluated on the CPU, as the shaders do it.
#include "engine/scene/scene.h"
#include "shaders/shared/brdf.h"

namespace daylit {

/// Filtered texel in [0,1], as coded in the file (no sRGB decoding); bilinear or nearest with the sampler's wrap modes.
Rgba sample_texture(const Scene& scene, const TextureRef& ref, const std::array<Vec2, 2>& uvs);
/// Bilinear mixing of *decoded* values, as GL does for SRGB8_ALPHA8: RGB linear, A as is.
Rgba sample_texture_srgb(const Scene& scene, const TextureRef& ref, const std::array<Vec2, 2>& uvs);

/// Base colour times vertex colour times texture; .a is coverage after the alpha mode: OPAQUE 1, MASK 0 or 1, BLEND
/// alpha.
Rgba base_color(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs, const Rgba& vertex_color);

/// The .a of base_color() alone, which rays through leaves and lattices ask for all the time.
float coverage(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs, float vertex_alpha);

/// Emitted radiance, cd/m^2, of both sides.
Rgb emission(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs);

/// Share that is smooth glass; the rest is opaque.
float transmission(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs);

/// The reflecting part of a material at a point, that of its opaque rest where some is glass, through the one mapping
/// of shaders/shared/brdf.h.
glsl::Brdf surface_brdf(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs,
                        const Rgba& vertex_color);

/// Shading normal from the normal texture; `normal` itself when there is none. Unit, world space.
Vec3 shading_normal(const Scene& scene, const Material& material, const std::array<Vec2, 2>& uvs, const Vec3& normal,
                    const Vec4& tangent);

/// Cosine between the normals of a normal map and the surface's, averaged over the whole picture: what is left of
/// straight light on the surface once its normals lean. 1 without a map.
float mean_cosine(const Scene& scene, const Material& material);

}  // namespace daylit
