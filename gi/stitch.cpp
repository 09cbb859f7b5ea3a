#include "gi/stitch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/vec.h"
#include "gi/surface/charts.h"
#include "gi/surface/point_tree.h"
#include "gi/surface/smooth.h"

namespace daylit {
namespace {

constexpr std::size_t kNeighbours = 24;
constexpr float kSigma = 0.6f;        // of the Gaussian about a texel, of its width: next to it others count as much
constexpr float kReach = 2.5f;        // sigmas
constexpr float kLeastFacing = 0.3f;  // cosine with a texel's normal at which it counts no more

/// A pixel of the atlas, the texel whose footprint it lies in, and what its light is made of.
struct Blend {
    std::uint32_t pixel = 0, own = 0;
    std::vector<std::pair<std::uint32_t, float>> from;  // texels and weights that sum to 1
};

/// A place on the surface as it is shaded.
struct Spot {
    Vec3 place = Vec3(0.0f), normal = Vec3(0.0f);
};

bool thin(const PlacedChart& chart) {
    return chart.nx == 1 || chart.ny == 1;
}

/// Weights of the corners at the point of a triangle that is nearest to q.
Vec3 nearest_weights(const std::array<Vec2, 3>& p, const Vec2& q) {
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
    const float area = cross(p[1] - p[0], p[2] - p[0]);
    Vec3 inside(0.0f), best(1, 0, 0);
    for (int k = 0; k < 3; ++k) inside[k] = cross(p[std::size_t(k + 1) % 3] - q, p[std::size_t(k + 2) % 3] - q) / area;
    if (area != 0.0f && std::min({inside.x, inside.y, inside.z}) >= 0.0f) return inside;
    float least = INFINITY;
    for (int k = 0; k < 3; ++k) {
        const Vec2 a = p[std::size_t(k)], e = p[std::size_t(k + 1) % 3] - a;
        const float square = glm::dot(e, e),
                    share = square > 0.0f ? glm::clamp(glm::dot(q - a, e) / square, 0.0f, 1.0f) : 0.0f;
        const float away = glm::distance(a + share * e, q);
        if (away >= least) continue;
        least = away, best = Vec3(0.0f);
        best[k] = 1.0f - share, best[(k + 1) % 3] = share;
    }
    return best;
}

class Stitcher {
  public:
    Stitcher(const SolvedDay& solved, const std::vector<bool>& open, std::span<const std::uint32_t> row)
        : solved_(solved), texels_(solved.texels), atlas_(solved.atlas) {
        const std::vector<std::uint32_t> piece = smooth_pieces(solved.input.mesh);
        for (const PlacedChart& c : atlas_.charts) piece_.push_back(piece[c.chart.triangles.front()]);
        plain_.resize(texels_.count());
        for (std::uint32_t t = 0; t < plain_.size(); ++t)
            plain_[t] = open[t] && !texels_.covered[t] && row[t] == t && texels_.texel_of_cell[texels_.cell[t]] == t &&
                        texels_.next_part[t] == kNoTexel;
        const std::vector<bool> joined = pieces_to_stitch(piece.size());
        for (std::uint32_t t = 0; t < plain_.size(); ++t)
            if (plain_[t] && joined[piece_[texels_.chart[t]]])
                texel_of_point_.push_back(t), points_.push_back(texels_.position[t]);
        tree_.buildIndex();
    }

    std::vector<Blend> blends(std::uint32_t chart) const {
        const PlacedChart& c = atlas_.charts[chart];
        if (!thin(c) || points_.empty() || !all_plain(chart)) return {};
        std::vector<Blend> result;
        for (int y = 0; y < c.atlas_height(); ++y)
            for (int x = 0; x < c.atlas_width(); ++x) {
                const auto pixel = std::uint32_t((c.y + y) * atlas_.width + c.x + x);
                const std::uint32_t cell =
                    texels_.first_cell[chart] + std::uint32_t(std::min(y, c.ny - 1) * c.nx + std::min(x, c.nx - 1));
                Blend blend{pixel, texels_.nearest_texel_of_cell[cell], {}};
                blend.from = around(spot(c, Vec2(x, y)), blend.own);
                if (blend.from.size() > 1) result.push_back(std::move(blend));
            }
        return result;
    }

  private:
    /// Of several charts, one of them thin.
    std::vector<bool> pieces_to_stitch(std::size_t count) const {
        std::vector<std::uint32_t> charts(count);
        std::vector<bool> result(count);
        for (const std::uint32_t piece : piece_) ++charts[piece];
        for (std::size_t c = 0; c < piece_.size(); ++c)
            if (thin(atlas_.charts[c]) && charts[piece_[c]] > 1) result[piece_[c]] = true;
        return result;
    }

    bool all_plain(std::uint32_t chart) const {
        for (std::uint32_t cell = texels_.first_cell[chart]; cell < texels_.first_cell[chart + 1]; ++cell)
            if (const std::uint32_t t = texels_.texel_of_cell[cell]; t != kNoTexel && !plain_[t]) return false;
        return true;
    }

    /// Of the chart's surface, nearest to a place of its grid.
    Spot spot(const PlacedChart& c, const Vec2& grid) const {
        const WorldMesh& mesh = solved_.input.mesh;
        Spot best;
        float least = INFINITY;
        for (const std::uint32_t t : c.chart.triangles) {
            std::array<Vec2, 3> p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = atlas_.corner_grids[3 * std::size_t(t) + k] * c.step;
            const Vec3 w = nearest_weights(p, grid * c.step);
            const float away = glm::distance(w.x * p[0] + w.y * p[1] + w.z * p[2], grid * c.step);
            if (away >= least) continue;
            least = away, best = {};
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t vertex = mesh.indices[3 * std::size_t(t) + std::size_t(k)];
                best.place += w[k] * mesh.positions[vertex], best.normal += w[k] * mesh.normals[vertex];
            }
            best.normal = unit_or(best.normal, geometric_normal(mesh, t));
        }
        return best;
    }

    std::vector<std::pair<std::uint32_t, float>> around(const Spot& spot, std::uint32_t own) const {
        std::array<std::uint32_t, kNeighbours> found;
        std::array<float, kNeighbours> squares;
        const std::size_t n = tree_.knnSearch(&spot.place.x, kNeighbours, found.data(), squares.data());
        std::sort(found.begin(), found.begin() + std::ptrdiff_t(n));  // a fixed order of summation
        std::vector<std::pair<std::uint32_t, float>> result;
        float sum = 0.0f;
        for (std::size_t k = 0; k < n; ++k) {
            const std::uint32_t t = texel_of_point_[found[k]];
            const float w = weight(spot, own, t);
            if (w > 0.0f) result.emplace_back(t, w), sum += w;
        }
        for (auto& [texel, w] : result) w /= sum;
        return result;
    }

    float weight(const Spot& spot, std::uint32_t own, std::uint32_t t) const {
        if (piece_[texels_.chart[t]] != piece_[texels_.chart[own]]) return 0.0f;
        const float away = glm::distance(spot.place, texels_.position[t]) / (kSigma * texels_.width[t]);
        const float facing = (glm::dot(spot.normal, texels_.normal[t]) - kLeastFacing) / (1.0f - kLeastFacing);
        if (away > kReach || facing <= 0.0f || (t != own && !sees(own, t))) return 0.0f;
        return facing * std::exp(-0.5f * away * away);
    }

    bool sees(std::uint32_t a, std::uint32_t b) const {
        return in_sight(solved_.rays, just_above(texels_, solved_.hits.nearness, a),
                        just_above(texels_, solved_.hits.nearness, b));
    }

    const SolvedDay& solved_;
    const Texels& texels_;
    const Atlas& atlas_;
    std::vector<std::uint32_t> piece_;  // per chart
    std::vector<bool> plain_;           // per texel: in the open, bare, alone in its cell, and shown
    std::vector<std::uint32_t> texel_of_point_;
    std::vector<Vec3> points_;  // where texels may be taken from
    PointCloud cloud_{points_};
    PointTree tree_{3, cloud_, kPointsOfLeaf};
};

void add_row(const Blend& blend, LightmapRows& rows) {
    const auto components = std::size_t(rows.basis.components);
    rows.row_of_pixel[blend.pixel] = std::uint32_t(rows.texels.size() / components);
    for (std::size_t r = 0; r < components; ++r) {
        Rgb sum(0.0f);
        for (const auto& [texel, weight] : blend.from) sum += weight * rows.texels[texel * components + r];
        rows.texels.push_back(sum);
    }
    if (!rows.tilts.row_of_texel.empty()) rows.tilts.row_of_texel.push_back(rows.tilts.row_of_texel[blend.own]);
}

}  // namespace

void stitch_thin_charts(const SolvedDay& solved, const std::vector<bool>& open, std::span<const std::uint32_t> row,
                        LightmapRows& rows) {
    const Stitcher stitcher(solved, open, row);
    std::vector<std::vector<Blend>> blends(solved.atlas.charts.size());
    tbb::parallel_for(std::size_t(0), blends.size(),
                      [&](std::size_t chart) { blends[chart] = stitcher.blends(std::uint32_t(chart)); });
    std::size_t more = 0;
    for (const auto& of_chart : blends) more += of_chart.size();
    rows.texels.reserve(rows.texels.size() + more * std::size_t(rows.basis.components));
    for (const auto& of_chart : blends)
        for (const Blend& blend : of_chart) add_row(blend, rows);
}

}  // namespace daylit
