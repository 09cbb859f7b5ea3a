#pragma once
// How light scatters at a point of a path: the shared BRDF (shaders/shared/brdf.h) and smooth glass.
#include <optional>

#include "engine/base/random.h"
#include "gi/transport/path_trace/sampling.h"
#include "shaders/shared/brdf.h"

namespace daylit {

/// An opaque surface at one point, for light that reaches the eye along `view`.
/// Light and view lie on the geometric normal's side, so nothing shines through a surface, however its shading normal
/// leans; the cosine is that of the shading normal.
class Reflection {
  public:
    Reflection(const glsl::Brdf& brdf, const Vec3& geometric_normal, const Vec3& shading_normal, const Vec3& view);
    /// A white Lambert surface of albedo pi: what it "reflects" is its irradiance.
    static Reflection irradiance(const Vec3& geometric_normal, const Vec3& shading_normal);

    /// f times the cosine, 1/sr, and the density per solid angle with which sample() draws this direction.
    struct Value {
        Rgb f_cos = Rgb(0.0f);
        float pdf = 0.0f;
    };
    Value evaluate_with_pdf(const Vec3& light) const;

    struct Sample {
        Vec3 direction;
        Rgb weight;  // f cos / pdf
        float pdf;
    };
    /// Nothing when the surface is black or the draw falls below the surface.
    std::optional<Sample> sample(Random& random) const;

  private:
    glsl::Brdf brdf_;
    Vec3 geometric_normal_, shading_normal_, mirror_;
    float lobe_chance_;  // of drawing from the Phong lobe; < 0: black
};

/// Share of unpolarised light reflected at the smooth boundary of a dielectric (Fresnel).
/// cosine   of the incoming direction, 0 to 1
/// eta      index of the far side over that of the near side
float fresnel_dielectric(float cosine, float eta);

/// Smooth glass: draws reflection or refraction by Fresnel's share.
struct GlassBounce {
    Vec3 direction;
    bool transmitted;
};
/// incoming   towards the surface; normal: unit, against it; eta: far over near index; u uniform in [0,1)
GlassBounce sample_glass(const Vec3& incoming, const Vec3& normal, float eta, float u);

/// Glass so thin that light leaves it where it came in: a pane modelled as one sheet. Straight through or mirrored;
/// reflectance 2R / (1 + R) of the two boundaries and all that happens between them (Stokes 1862).
GlassBounce sample_pane(const Vec3& incoming, const Vec3& normal, float ior, float u);

}  // namespace daylit
