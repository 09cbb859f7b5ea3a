#include "gi/trace/line_of_sight.h"

#include <cmath>

namespace daylit {

bool in_sight(const RayScene& rays, const Vec3& from, const Vec3& to) {
    const float distance = glm::distance(from, to);
    return distance == 0.0f || rays.transmittance({from, (to - from) / distance, 0.0f, distance}) > 0.0f;
}

bool buried(const RayScene& rays, const Vec3& place) {
    constexpr int kLooks = 64;
    int backs = 0;
    for (int look = 0; look < kLooks; ++look) {
        // Evenly over the sphere, a golden angle apart (Swinbank and Purser 2006).
        const float y = 1.0f - (2.0f * float(look) + 1.0f) / float(kLooks), r = std::sqrt(1.0f - y * y);
        const float turn = 2.39996323f * float(look);
        const Vec3 direction(r * std::cos(turn), y, r * std::sin(turn));
        const std::optional<Hit> met = rays.closest({place, direction}, std::uint64_t(look));
        backs += met && glm::dot(direction, met->normal) > 0.0f;
    }
    return 2 * backs > kLooks;
}

}  // namespace daylit
