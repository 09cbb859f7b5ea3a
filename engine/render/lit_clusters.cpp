#include "engine/render/lit_clusters.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "engine/gl/target.h"
#include "engine/render/farthest_depth.h"

namespace daylit {
namespace {

constexpr int kSide = 512;  // texels of the map of numbers
constexpr float kFound = 32.0f;  // texels: of a triangle this large the map misses only light narrower than a texel
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A lamp's map: the nearest clusters' numbers, and how far away they are.
class NumberMap {
  public:
    NumberMap()
        : numbers_(make_texture_2d(GL_R16UI, kSide, kSide, 1, {GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_NONE})),
          depth_(make_texture_2d(GL_DEPTH_COMPONENT32F, kSide, kSide)),
          framebuffer_(make_framebuffer({numbers_.get()}, depth_.get())),
          seen_(std::size_t(kSide) * kSide) {}

    /// Row 0 is at the bottom.
    const std::vector<std::uint16_t>& draw(DrawScene& scene, const Mat4& matrix) {
        const GLuint nothing[4] = {65535, 0, 0, 0};
        const float far = 0.0f;
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
        glViewport(0, 0, kSide, kSide);
        glClearNamedFramebufferuiv(framebuffer_.get(), GL_COLOR, 0, nothing);
        glClearNamedFramebufferfv(framebuffer_.get(), GL_DEPTH, 0, &far);
        scene.draw_clusters(matrix, frustum(matrix, true));
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glGetTextureImage(numbers_.get(), 0, GL_RED_INTEGER, GL_UNSIGNED_SHORT, GLsizei(seen_.size() * 2),
                          seen_.data());
        return seen_;
    }

    /// Metres along the map's axis to what was drawn last.
    FarthestDepth farthest() const {
        std::vector<float> distance(seen_.size());
        glGetTextureImage(depth_.get(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, GLsizei(distance.size() * sizeof(float)),
                          distance.data());
        for (float& d : distance) d = d > 0.0f ? glsl::kLampNear / d : kInfinity;
        return FarthestDepth(kSide, std::move(distance));
    }

  private:
    GlTexture numbers_, depth_;
    GlFramebuffer framebuffer_;
    std::vector<std::uint16_t> seen_;
};

/// Small triangles may be lit between the centres of the map's texels. What shaders/lamps.glsl would find of them is
/// bounded as it finds it: the triangle's plane over all texels that a look-up may fetch, against the farthest that
/// lies there.
class SmallTriangles {
  public:
    SmallTriangles(const LampFit& fit, const LampMap& map, int texels, FarthestDepth farthest)
        : position_(fit.block.position),
          span_(fit.tan_half),
          across_(map.x, glm::cross(map.z, map.x), map.z),
          texel_(1.0f / float(std::min(texels, kSide))),
          farthest_(std::move(farthest)) {}

    bool may_be_lit(const TriangleCorners& triangle, bool double_sided) const {
        TriangleCorners p;  // seen from the lamp
        for (std::size_t i = 0; i < 3; ++i) p[i] = (triangle[i] - position_) * across_;
        const Vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const float area = glm::length(normal);
        if (area == 0.0f) return false;  // covers no pixel
        if (!double_sided && -glm::dot(normal, p[0]) < kTurnedAway * area * glm::length(p[0])) return false;
        Vec2 place[3], min(kInfinity), max(-kInfinity);  // shares of the map's side
        for (std::size_t i = 0; i < 3; ++i) {
            if (p[i].z < glsl::kLampNear) return false;  // another map's, or so near that it is large
            place[i] = Vec2(p[i]) / (p[i].z * span_) * 0.5f + 0.5f;
            min = glm::min(min, place[i]);
            max = glm::max(max, place[i]);
        }
        if (max.x < 0.0f || max.y < 0.0f || min.x > 1.0f || min.y > 1.0f) return false;
        const Vec2 u = place[1] - place[0], v = place[2] - place[0];
        if (0.5f * std::abs(u.x * v.y - u.y * v.x) * float(kSide * kSide) > kFound) return false;
        min -= 1.5f * texel_;
        max += 1.5f * texel_;
        return farthest_.over(min * float(kSide), max * float(kSide)) >= nearest(normal / area, p[0], min, max);
    }

  private:
    /// Least distance along the axis of the plane over a rectangle of the map, less the shader's slack.
    float nearest(const Vec3& normal, const Vec3& on_plane, const Vec2& min, const Vec2& max) const {
        const Vec3 n = glm::dot(normal, on_plane) < 0.0f ? normal : -normal;
        float least = kInfinity;
        for (const Vec2& at : {min, max, Vec2(min.x, max.y), Vec2(max.x, min.y)}) {
            const Vec2 ray = (2.0f * at - 1.0f) * span_;
            least = std::min(least, glm::dot(n, on_plane) / std::min(glm::dot(n, Vec3(ray, 1.0f)), -1.0e-4f));
        }
        return least * (1.0f - 0.5f * span_ * texel_) - 2.0e-3f;
    }

    Vec3 position_;
    float span_;
    glm::mat3 across_;
    float texel_;  // of the coarser map, as a share of its side
    FarthestDepth farthest_;
};

/// Sets the bit of every cluster of what stands that holds a small triangle that may be lit.
void add_small(DrawScene& scene, const SmallTriangles& small, const Frustum& seen, std::size_t word,
               std::uint32_t bit) {
    const DrawMesh& mesh = scene.parts[0]->mesh();
    tbb::parallel_for(std::size_t(0), mesh.batches.size(), [&](std::size_t b) {
        const Batch& batch = mesh.batches[b];
        const bool double_sided = scene.material(batch).double_sided;
        for (std::uint32_t c = batch.first_cluster; c < batch.first_cluster + batch.cluster_count; ++c) {
            const Cluster& cluster = mesh.clusters[c];
            if ((scene.lamp_bits[c][word] & bit) || !may_see(seen, cluster.bounds)) continue;
            for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; i += 3) {
                const auto corner = [&](std::uint32_t k) { return mesh.positions[mesh.indices[i + k]]; };
                if (!small.may_be_lit({corner(0), corner(1), corner(2)}, double_sided)) continue;
                scene.lamp_bits[c][word] |= bit;
                break;
            }
        }
    });
}

}  // namespace

void LitClusters::find(DrawScene& scene, std::span<const LampFit> lamps, int texels) {
    // A number of a cluster is known modulo 2^16 only.
    const std::size_t clusters = scene.parts[0] ? scene.parts[0]->mesh().clusters.size() : 0;
    if (clusters >= 65535) return scene.lamp_bits.clear();
    const bool all =
        version_ != scene.standing_version || scene.lamp_bits.size() != clusters || known_.size() != lamps.size();
    if (all) scene.lamp_bits.assign(clusters, LampBits{});
    std::optional<NumberMap> numbers;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        if (!all && same_maps(lamps[i], known_[i])) continue;
        const std::size_t word = i / 32;
        const std::uint32_t bit = 1u << (i % 32);
        for (LampBits& bits : scene.lamp_bits) bits[word] = lamps[i].moves ? bits[word] | bit : bits[word] & ~bit;
        if (lamps[i].moves || clusters == 0) continue;  // it would have to be asked again every frame
        for (const LampMap& map : lamps[i].maps) {
            if (!numbers) numbers.emplace();
            const Mat4 matrix = lamp_matrix(lamps[i], map);
            for (const std::uint16_t cluster : numbers->draw(scene, matrix))
                if (cluster < clusters) scene.lamp_bits[cluster][word] |= bit;
            add_small(scene, {lamps[i], map, texels, numbers->farthest()}, frustum(matrix, true), word, bit);
        }
    }
    known_.assign(lamps.begin(), lamps.end());
    version_ = scene.standing_version;
}

}  // namespace daylit
