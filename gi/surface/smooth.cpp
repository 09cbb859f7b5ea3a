#include "gi/surface/smooth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gi/surface/point_tree.h"
#include "gi/transport/path_trace/sampling.h"

namespace daylit {
namespace {

constexpr std::size_t kNeighbours = 48;
constexpr float kSigma = 1.6f;            // of the Gaussian, texels
constexpr float kSigmaOfNearness = 0.2f;  // and at most this share of the mean distance of what is seen
constexpr float kReach = 2.5f;            // sigmas
constexpr float kLeastFacing = 0.9f;
constexpr float kPlane = 0.25f;  // texels out of the tangent plane at which the weight falls to 1/e
constexpr double kStiff = 0.01;  // squared texels on top of the neighbours' spread: few of them tell no slope

class Neighbourhood {
  public:
    Neighbourhood(const RayScene& rays, const Texels& texels, std::span<const float> nearness,
                  const std::vector<bool>& usable)
        : rays_(rays), texels_(texels), nearness_(nearness), usable_(usable) {}

    /// The weight of b for a; 0 when they are not on one open piece of surface.
    float weight(std::uint32_t a, std::uint32_t b) const {
        if (a == b) return 1.0f;
        if (!usable_[b]) return 0.0f;
        const float width = texels_.width[a];
        const float sigma = std::min(kSigma * width, kSigmaOfNearness * std::min(nearness_[a], nearness_[b]));
        const Vec3 offset = texels_.position[b] - texels_.position[a];
        const float square = glm::dot(offset, offset);
        const float cosine = glm::dot(texels_.normal[a], texels_.normal[b]);
        if (square > kReach * kReach * sigma * sigma || cosine < kLeastFacing) return 0.0f;
        const float out =
            std::max(std::abs(glm::dot(offset, texels_.normal[a])), std::abs(glm::dot(offset, texels_.normal[b])));
        const float in_plane = out / (kPlane * width);
        if (!sees(a, b)) return 0.0f;
        return std::exp(-0.5f * square / (sigma * sigma) - in_plane * in_plane) * (cosine - kLeastFacing) /
               (1.0f - kLeastFacing);
    }

  private:
    bool sees(std::uint32_t a, std::uint32_t b) const {
        return in_sight(rays_, just_above(texels_, nearness_, a), just_above(texels_, nearness_, b));
    }

    const RayScene& rays_;
    const Texels& texels_;
    std::span<const float> nearness_;
    const std::vector<bool>& usable_;
};

/// Makes weights of a mean (sum 1) those of a plane fitted by least squares with them, read at the texel: a mean of
/// neighbours that lie to one side, as along a rim, is the light farther in.
void fit_plane(const Texels& texels, std::uint32_t texel, std::span<const std::uint32_t> ids, std::span<float> weight) {
    const Frame frame(texels.normal[texel]);
    std::array<glm::dvec2, kNeighbours> place;
    glm::dvec2 middle(0.0);
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const Vec3 offset = texels.position[ids[k]] - texels.position[texel];
        place[k] = {glm::dot(offset, frame.x), glm::dot(offset, frame.y)};
        middle += double(weight[k]) * place[k];
    }
    const double width = double(texels.width[texel]);
    glm::dmat2 spread(kStiff * width * width);
    for (std::size_t k = 0; k < ids.size(); ++k)
        spread += double(weight[k]) * glm::outerProduct(place[k] - middle, place[k] - middle);
    const glm::dvec2 lean = glm::inverse(spread) * middle;
    for (std::size_t k = 0; k < ids.size(); ++k) weight[k] *= float(1.0 - glm::dot(lean, place[k] - middle));
}

}  // namespace

Vec3 just_above(const Texels& texels, std::span<const float> nearness, std::uint32_t texel) {
    const float height = std::min(kSightHeight * texels.width[texel], 0.3f * nearness[texel]);
    return texels.position[texel] + height * texels.normal[texel];
}

SmoothingWeights smoothing_weights(const RayScene& rays, const Texels& texels, std::span<const float> nearness,
                                   const std::vector<bool>& usable) {
    const std::size_t count = texels.count();
    const PointCloud cloud{texels.position};
    PointTree tree(3, cloud, kPointsOfLeaf);
    tree.buildIndex();
    const Neighbourhood neighbourhood(rays, texels, nearness, usable);
    std::vector<std::uint32_t> found(count * kNeighbours, kNoTexel);
    std::vector<float> weight(count * kNeighbours, 0.0f);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t t) {
        if (!usable[t]) return;
        std::array<float, kNeighbours> squares;
        std::uint32_t* ids = found.data() + t * kNeighbours;
        const std::size_t n = tree.knnSearch(&texels.position[t].x, kNeighbours, ids, squares.data());
        std::sort(ids, ids + n);  // a fixed order of summation
        float sum = 0.0f;
        for (std::size_t k = 0; k < n; ++k)
            sum += weight[t * kNeighbours + k] = neighbourhood.weight(std::uint32_t(t), ids[k]);
        if (sum <= 0.0f) ids[0] = std::uint32_t(t), weight[t * kNeighbours] = sum = 1.0f;  // many at one place
        const std::span<float> weights(weight.data() + t * kNeighbours, n);
        for (float& w : weights) w /= sum;
        fit_plane(texels, std::uint32_t(t), {ids, n}, weights);
    });

    SmoothingWeights result;
    result.first.push_back(0);
    for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t k = t * kNeighbours; k < (t + 1) * kNeighbours; ++k)
            if (weight[k] != 0.0f) result.texel.push_back(found[k]), result.weight.push_back(weight[k]);
        result.first.push_back(std::uint32_t(result.texel.size()));
    }
    return result;
}

void smooth(const SmoothingWeights& weights, std::size_t columns, std::vector<Rgb>& rows) {
    const std::size_t count = weights.first.size() - 1;
    std::vector<Rgb> block(count * kColumnsAtOnce);
    for (std::size_t first = 0; first < columns; first += kColumnsAtOnce) {
        const std::size_t width = std::min(kColumnsAtOnce, columns - first);
        tbb::parallel_for(std::size_t(0), count, [&](std::size_t t) {
            Rgb* out = block.data() + t * kColumnsAtOnce;
            std::fill_n(out, width, Rgb(0.0f));
            for (std::uint32_t k = weights.first[t]; k < weights.first[t + 1]; ++k) {
                const Rgb* in = rows.data() + std::size_t(weights.texel[k]) * columns + first;
                for (std::size_t c = 0; c < width; ++c) out[c] += weights.weight[k] * in[c];
            }
        });
        tbb::parallel_for(std::size_t(0), count, [&](std::size_t t) {
            std::copy_n(block.data() + t * kColumnsAtOnce, width, rows.data() + t * columns + first);
        });
    }
}

}  // namespace daylit
