#include "engine/render/culling.h"

namespace daylit {

Frustum frustum(const Mat4& m, bool infinite_reversed) {
    const auto row = [&](int i) { return Vec4(m[0][i], m[1][i], m[2][i], m[3][i]); };
    const Vec4 x = row(0), y = row(1), z = row(2), w = row(3);
    // The plane z = 0 comes last, where it is left out.
    return {{w + x, w - x, w + y, w - y, w - z, z}, infinite_reversed ? 5 : 6};
}

bool may_see(const Frustum& frustum, const Bounds& box) {
    for (int i = 0; i < frustum.count; ++i) {
        const Vec4& plane = frustum.planes[std::size_t(i)];
        const Vec3 furthest(plane.x > 0 ? box.max.x : box.min.x, plane.y > 0 ? box.max.y : box.min.y,
                            plane.z > 0 ? box.max.z : box.min.z);
        if (glm::dot(Vec3(plane), furthest) + plane.w < 0.0f) return false;
    }
    return true;
}

}  // namespace daylit
