#include "engine/render/sun_reach.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

constexpr int kDeepest = 6;            // times that a triangle is cut into four
constexpr float kBlockTexels = 4.0f;   // of level 0, as the pyramid on the GPU has it
constexpr float kWorthCutting = 4.0f;  // blocks: smaller triangles are as the map sees them

struct ShadowSpace {
    Vec2 min = Vec2(1.0e30f), max = Vec2(-1.0e30f);  // metres across the light
    float nearest = 1.0e30f, farthest = 0.0f;        // metres along it
};

class Reach {
  public:
    Reach(const SunFit& fit, std::span<const FarthestDepth> maps, int texels, float steepness)
        : fit_(fit), maps_(maps), texels_(float(texels)), steepness_(steepness) {}

    /// In shadow space: x, y across, z depth.
    bool may_reach(const TriangleCorners& p, int depth) const {
        ShadowSpace box;
        for (const Vec3& corner : p) {
            box.min = glm::min(box.min, Vec2(corner));
            box.max = glm::max(box.max, Vec2(corner));
            box.nearest = std::min(box.nearest, corner.z);
            box.farthest = std::max(box.farthest, corner.z);
        }
        float block = 0.0f;  // metres, of the finest map that is asked
        if (shadowed(box, block)) return false;
        const Vec2 size = box.max - box.min;
        if (depth == kDeepest || std::max(std::max(size.x, size.y), box.farthest - box.nearest) < kWorthCutting * block)
            return true;
        const Vec3 ab = 0.5f * (p[0] + p[1]), bc = 0.5f * (p[1] + p[2]), ca = 0.5f * (p[2] + p[0]);
        return may_reach({p[0], ab, ca}, depth + 1) || may_reach({ab, p[1], bc}, depth + 1) ||
               may_reach({ca, bc, p[2]}, depth + 1) || may_reach({ab, bc, ca}, depth + 1);
    }

  private:
    /// Every cascade that some point of the box may ask has something nearer to the sun on all of its kernel.
    bool shadowed(const ShadowSpace& box, float& block) const {
        for (std::size_t c = 0; c < fit_.cascades.size(); ++c) {
            const Vec4& cascade = fit_.cascades[c];
            const Vec2 center(cascade), low = box.min - center, high = box.max - center;
            const float usable = cascade.w, texel = cascade.z;
            if (low.x >= usable || low.y >= usable || high.x <= -usable || high.y <= -usable) continue;
            if (block == 0.0f) block = kBlockTexels * texel;
            // The widest kernel that the shader can choose, and the receiver's own plane over it.
            const float tangent = std::tan(float(kSunRadius));
            const float kernel = tangent / std::max(1.0f - tangent * steepness_, 0.5f) * box.farthest + 3.0f * texel;
            const float slack = 2.0e-4f + 1.0e-5f * box.farthest + texel * (0.05f + 0.1f * steepness_);
            const float nearest = box.nearest - slack - steepness_ * kernel;
            const Vec2 to_blocks = Vec2(1.0f / (texel * kBlockTexels));
            const Vec2 middle(0.5f * texels_ / kBlockTexels);
            const float blocker = maps_[c].over((glm::max(low, Vec2(-usable)) - kernel) * to_blocks + middle,
                                                (glm::min(high, Vec2(usable)) + kernel) * to_blocks + middle);
            if (blocker * fit_.depth_range >= nearest) return false;
            if (low.x > -usable && low.y > -usable && high.x < usable && high.y < usable) return true;
        }
        return false;  // beyond the last cascade all is lit
    }

    const SunFit& fit_;
    std::span<const FarthestDepth> maps_;
    float texels_, steepness_;
};

}  // namespace

bool may_reach(const SunFit& fit, std::span<const FarthestDepth> maps, int texels, const TriangleCorners& triangle,
               bool double_sided) {
    const Vec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const float area = glm::length(normal);
    if (area == 0.0f) return false;  // covers no pixel
    const Vec3 sun(fit.block.direction);
    const float facing = glm::dot(normal, sun) / area;
    if (!double_sided && facing < kTurnedAway) return false;
    const float steep = std::sqrt(std::max(1.0f - facing * facing, 0.0f)) / std::max(std::abs(facing), 0.02f);
    TriangleCorners p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = {glm::dot(Vec3(fit.block.axis_x), triangle[i]), glm::dot(Vec3(fit.block.axis_y), triangle[i]),
                fit.block.direction.w - glm::dot(sun, triangle[i])};
    return Reach(fit, maps, texels, 1.02f * steep + 0.01f).may_reach(p, 0);
}

}  // namespace daylit
