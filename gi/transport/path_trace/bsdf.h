#pragma once
// How light scatters at a point of a path: the shared BRDF (shaders/shared/brdf.h) and smooth glass.
#include <cmath>

#include "gi/transport/path_trace/sampling.h"
#include "shaders/shared/brdf.h"

namespace daylit {

/// An opaque surface at one point, for light that reaches the eye along `view`.
/// Light and view lie on the geometric normal's side, so nothing shines through a surface, however its shading normal
/// leans; the cosine is that of the shading normal.
class Reflection {
  public:
    Reflection(const glsl::Brdf& brdf, const Vec3& geometric_normal, const Vec3& shading_normal, const Vec3& view)
        : brdf_(without_flat_lobe(brdf)),
          geometric_normal_(geometric_normal),
          shading_normal_(shading_normal),
          mirror_(glm::reflect(-view, shading_normal)),
          lobe_chance_(lobe_share(brdf_)) {}
    /// A white Lambert surface of albedo pi: what it "reflects" is its irradiance.
    static Reflection irradiance(const Vec3& geometric_normal, const Vec3& shading_normal) {
        return Reflection({.diffuse = Rgb(kPiF), .specular = Rgb(0.0f), .exponent = 0.0f}, geometric_normal,
                          shading_normal, shading_normal);
    }

    /// False when nothing arrives from directions within the angle of this sine around `centre`.
    bool may_receive(const Vec3& centre, float sine) const {
        return lobe_chance_ >= 0.0f && glm::dot(geometric_normal_, centre) > -sine &&
               glm::dot(shading_normal_, centre) > -sine;
    }

    /// f times the cosine, 1/sr, and the density per solid angle with which sample() draws this direction.
    struct Value {
        Rgb f_cos = Rgb(0.0f);
        float pdf = 0.0f;
    };
    Value evaluate_with_pdf(const Vec3& light) const;

    struct Sample {
        Vec3 direction = Vec3(0.0f);
        Rgb weight = Rgb(0.0f);  // f cos / pdf
        float pdf = 0.0f;        // 0: nothing, when the surface is black or the draw falls below the surface
    };
    /// u   uniform in [0,1)^2
    Sample sample(Vec2 u) const;

  private:
    /// The lobe of exponent 0 is that of Lambert, in all directions: not only in those about the mirrored view.
    static glsl::Brdf without_flat_lobe(const glsl::Brdf& brdf) {
        if (brdf.exponent > 0.0f) return brdf;
        return {.diffuse = brdf.diffuse + brdf.specular, .specular = Rgb(0.0f), .exponent = 0.0f};
    }
    /// Share of the Phong lobe in what is reflected; < 0: black.
    static float lobe_share(const glsl::Brdf& brdf) {
        const float diffuse = luminance(brdf.diffuse), specular = luminance(brdf.specular);
        return diffuse + specular > 0.0f ? specular / (diffuse + specular) : -1.0f;
    }

    glsl::Brdf brdf_;
    Vec3 geometric_normal_, shading_normal_, mirror_;
    float lobe_chance_;  // of drawing from the Phong lobe; < 0: black
};

// These run several times a hit: inlined, they spare as much time again as they take.
inline Reflection::Value Reflection::evaluate_with_pdf(const Vec3& light) const {
    const float cosine = glm::dot(shading_normal_, light);
    if (lobe_chance_ < 0.0f || cosine <= 0.0f || glm::dot(geometric_normal_, light) <= 0.0f) return {};
    const float diffuse_pdf = cosine * kInversePi;
    if (lobe_chance_ == 0.0f) return {brdf_.diffuse * diffuse_pdf, diffuse_pdf};
    // As evaluate_brdf() of shaders/shared/brdf.h, but the one power serves the value and the density. Since
    // ln(c) <= c - 1, it is below e^-40 where it is not asked for.
    const float cos_lobe = glm::dot(mirror_, light);
    const bool lit = cos_lobe > 0.0f && brdf_.exponent * (1.0f - cos_lobe) < 40.0f;
    const float lobe = lit ? std::pow(cos_lobe, brdf_.exponent) * (0.5f * kInversePi) : 0.0f;
    return {brdf_.diffuse * diffuse_pdf + brdf_.specular * ((brdf_.exponent + 2.0f) * lobe * cosine),
            glm::mix(diffuse_pdf, (brdf_.exponent + 1.0f) * lobe, lobe_chance_)};
}

inline Reflection::Sample Reflection::sample(Vec2 u) const {
    if (lobe_chance_ < 0.0f) return {};
    const bool lobe = choose(u.x, lobe_chance_);
    // The shading normal is unit within rounding; the mirrored view carries that of the whole path.
    const Vec3 direction = lobe ? glm::normalize(Frame(mirror_).to_world(sample_phong_lobe(brdf_.exponent, u.x, u.y)))
                                : Frame(shading_normal_).to_world(sample_cosine_hemisphere(u.x, u.y));
    const Value value = evaluate_with_pdf(direction);
    if (value.f_cos == Rgb(0.0f) || !(value.pdf > 0.0f)) return {};
    return {direction, value.f_cos / value.pdf, value.pdf};
}

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
