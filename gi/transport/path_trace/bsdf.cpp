#include "gi/transport/path_trace/bsdf.h"

#include <cmath>

namespace daylit {
namespace {

float lobe_share(const glsl::Brdf& brdf) {
    const float diffuse = luminance(brdf.diffuse), specular = luminance(brdf.specular);
    return diffuse + specular > 0.0f ? specular / (diffuse + specular) : -1.0f;
}

}  // namespace

Reflection::Reflection(const glsl::Brdf& brdf, const Vec3& geometric_normal, const Vec3& shading_normal,
                       const Vec3& view)
    : brdf_(brdf), geometric_normal_(geometric_normal), shading_normal_(shading_normal),
      mirror_(glm::reflect(-view, shading_normal)), lobe_chance_(lobe_share(brdf)) {}

Reflection Reflection::irradiance(const Vec3& geometric_normal, const Vec3& shading_normal) {
    return Reflection({.diffuse = Rgb(kPiF), .specular = Rgb(0.0f), .exponent = 0.0f}, geometric_normal,
                      shading_normal, shading_normal);
}

Reflection::Value Reflection::evaluate_with_pdf(const Vec3& light) const {
    const float cosine = glm::dot(shading_normal_, light);
    if (lobe_chance_ < 0.0f || cosine <= 0.0f || glm::dot(geometric_normal_, light) <= 0.0f) return {};
    if (lobe_chance_ == 0.0f) return {brdf_.diffuse * (cosine / kPiF), cosine / kPiF};
    // As evaluate_brdf() of shaders/shared/brdf.h, but the one power serves the value and the density.
    const float cos_lobe = glm::dot(mirror_, light);
    const float lobe = cos_lobe > 0.0f ? std::pow(cos_lobe, brdf_.exponent) / (2.0f * kPiF) : 0.0f;
    return {(brdf_.diffuse / kPiF + brdf_.specular * ((brdf_.exponent + 2.0f) * lobe)) * cosine,
            glm::mix(pdf_cosine_hemisphere(cosine), (brdf_.exponent + 1.0f) * lobe, lobe_chance_)};
}

std::optional<Reflection::Sample> Reflection::sample(Random& random) const {
    if (lobe_chance_ < 0.0f) return std::nullopt;
    const bool lobe = lobe_chance_ > 0.0f && random.next() < lobe_chance_;
    const float u = random.next(), v = random.next();
    const Vec3 direction = glm::normalize(
        lobe ? Frame(mirror_).to_world(sample_phong_lobe(brdf_.exponent, u, v))
             : Frame(shading_normal_).to_world(sample_cosine_hemisphere(u, v)));
    const Value value = evaluate_with_pdf(direction);
    if (value.f_cos == Rgb(0.0f) || !(value.pdf > 0.0f)) return std::nullopt;
    return Sample{direction, value.f_cos / value.pdf, value.pdf};
}

float fresnel_dielectric(float cosine, float eta) {
    const float sin2_far = (1.0f - cosine * cosine) / (eta * eta);
    if (sin2_far >= 1.0f) return 1.0f;  // total internal reflection
    const float cos_far = std::sqrt(1.0f - sin2_far);
    const float parallel = (eta * cosine - cos_far) / (eta * cosine + cos_far);
    const float perpendicular = (cosine - eta * cos_far) / (cosine + eta * cos_far);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

GlassBounce sample_glass(const Vec3& incoming, const Vec3& normal, float eta, float u) {
    const float cosine = glm::clamp(-glm::dot(incoming, normal), 0.0f, 1.0f);
    if (u < fresnel_dielectric(cosine, eta)) return {glm::normalize(glm::reflect(incoming, normal)), false};
    const float cos_far = std::sqrt(std::max(1.0f - (1.0f - cosine * cosine) / (eta * eta), 0.0f));
    return {glm::normalize(incoming / eta + normal * (cosine / eta - cos_far)), true};
}

GlassBounce sample_pane(const Vec3& incoming, const Vec3& normal, float ior, float u) {
    const float r = fresnel_dielectric(glm::clamp(-glm::dot(incoming, normal), 0.0f, 1.0f), ior);
    if (u < 2.0f * r / (1.0f + r)) return {glm::normalize(glm::reflect(incoming, normal)), false};
    return {incoming, true};
}

}  // namespace daylit
