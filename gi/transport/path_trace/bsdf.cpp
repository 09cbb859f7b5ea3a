#include "gi/transport/path_trace/bsdf.h"

#include <cmath>

namespace daylit {
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
