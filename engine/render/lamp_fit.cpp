#include "engine/render/lamp_fit.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace daylit {
namespace {

constexpr float kWidestSpot = 1.05f;  // radians; wider cones get a cube

// As cube_face() in shaders/lamps.glsl.
constexpr Vec3 kFaceZ[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
constexpr Vec3 kFaceX[6] = {{0, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}};

}  // namespace

LampFit fit_lamp(const PlacedLight& lamp, int texels) {
    const bool spot = lamp.kind == LightKind::Spot;
    const float outer = spot ? std::acos(glm::clamp(lamp.cos_outer, -1.0f, 1.0f)) : float(kPi);
    const bool cube = outer > kWidestSpot;
    const Vec3 z = lamp.direction;
    const Vec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.99f ? Vec3(0, 1, 0) : Vec3(0, 0, 1), z));
    const float span = 1.0f + glsl::kLampBorder / float(texels);
    LampFit fit{};
    fit.tan_half = (cube ? 1.0f : std::tan(outer)) * span;
    fit.block.position = Vec4(lamp.position, lamp.range > 0.0f ? 1.0f / std::pow(lamp.range, 4.0f) : 0.0f);
    fit.block.intensity = Vec4(lamp.intensity, 0.0f);
    fit.block.direction = Vec4(z, 1.0f / std::max(lamp.cos_inner - lamp.cos_outer, 1.0e-4f));
    fit.block.axis_x = Vec4(x, spot ? lamp.cos_outer : -2.0f);
    fit.block.map = Vec4(cube ? 0.0f : fit.tan_half, 0.0f, 0.0f, 0.0f);
    if (!cube) fit.maps.push_back({x, z});
    for (int face = 0; cube && face < 6; ++face) fit.maps.push_back({kFaceX[face], kFaceZ[face]});
    return fit;
}

bool same_maps(const LampFit& a, const LampFit& b) {
    glsl::LampBlock block = a.block;
    block.intensity = Vec4(Vec3(b.block.intensity), block.intensity.w);
    return !std::memcmp(&block, &b.block, sizeof block);
}

Mat4 lamp_matrix(const LampFit& fit, const LampMap& map) {
    const Vec3 p = Vec3(fit.block.position);
    const Vec3 x = map.x / fit.tan_half, y = glm::cross(map.z, map.x) / fit.tan_half;
    return Mat4(Vec4(x.x, y.x, 0, map.z.x), Vec4(x.y, y.y, 0, map.z.y), Vec4(x.z, y.z, 0, map.z.z),
                Vec4(-glm::dot(x, p), -glm::dot(y, p), glsl::kLampNear, -glm::dot(map.z, p)));
}

}  // namespace daylit
