#include "gi/encode/volume_modes.h"

#include <algorithm>
#include <cmath>

#include "engine/baked/volume_tree.h"

namespace daylit {
namespace {

constexpr float kNearest = 1e-12f;  // of the squared distance, in sides: at a corner that corner alone counts
constexpr float kStep = 1e-3f;      // of t, of differences

Vec3 corner_at(int corner) {
    return Vec3(corner & 1, corner >> 1 & 1, corner >> 2);
}

std::array<float, 8> trilinear(const Vec3& t) {
    std::array<float, 8> weights;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 rest = Vec3(1.0f) - glm::abs(t - corner_at(corner));
        weights[std::size_t(corner)] = rest.x * rest.y * rest.z;
    }
    return weights;
}

std::array<float, 8> by_distance(const Vec3& t) {
    std::array<float, 8> weights;
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 d = t - corner_at(corner);
        const float squared = std::max(glm::dot(d, d), kNearest);
        sum += weights[std::size_t(corner)] = std::pow(squared, -0.5f * kAnnenExponent);
    }
    for (float& w : weights) w /= sum;
    return weights;
}

}  // namespace

const char* name(VolumeBlend blend) {
    switch (blend) {
        case VolumeBlend::Trilinear:
            return "trilinear";
        case VolumeBlend::Oat:
            return "Oat";
        case VolumeBlend::Annen:
            return "Annen";
        case VolumeBlend::Half:
            return "half gradient";
        case VolumeBlend::Adini:
            return "Adini-Hermite";
    }
    return "";
}

std::array<Vec4, 8> blend_weights(VolumeBlend blend, const Vec3& t, float side) {
    std::array<Vec4, 8> result;
    const float slope = blend == VolumeBlend::Trilinear ? 0.0f : blend == VolumeBlend::Half ? 0.5f : 1.0f;
    const std::array<float, 8> share = blend == VolumeBlend::Annen ? by_distance(t) : trilinear(t);
    for (int corner = 0; corner < 8; ++corner) {
        const float w = share[std::size_t(corner)];
        result[std::size_t(corner)] = blend == VolumeBlend::Adini ? glsl::volume_corner_weights(corner, t, side)
                                                                  : Vec4(w, slope * side * w * (t - corner_at(corner)));
    }
    return result;
}

std::array<Vec4, 8> blend_weights_change(VolumeBlend blend, const Vec3& t, float side, int axis) {
    std::array<Vec4, 8> result;
    if (blend == VolumeBlend::Adini) {
        for (int corner = 0; corner < 8; ++corner)
            result[std::size_t(corner)] = corner_weights_change(corner, t, side, axis);
        return result;
    }
    Vec3 before = t, after = t;  // one-sided at the cell's border, beyond which the weights mean nothing
    before[axis] = std::max(0.0f, t[axis] - kStep), after[axis] = std::min(1.0f, t[axis] + kStep);
    const std::array<Vec4, 8> low = blend_weights(blend, before, side), high = blend_weights(blend, after, side);
    for (std::size_t corner = 0; corner < 8; ++corner)
        result[corner] = (high[corner] - low[corner]) / ((after[axis] - before[axis]) * side);
    return result;
}

}  // namespace daylit
