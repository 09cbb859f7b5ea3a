#include "gi/surface/parting.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "engine/base/vec.h"
#include "gi/trace/line_of_sight.h"
#include "gi/transport/path_trace/sampling.h"

namespace daylit {
namespace {

constexpr std::size_t kMostCandidates = 32;  // texels beside a place

/// What lies on surfaces, or so close above them that nobody looks there but through a slit.
class Covers {
  public:
    Covers(const RayScene& rays, const Atlas& atlas) : rays_(rays) {
        double texels = 0.0, widths = 0.0;
        for (const PlacedChart& c : atlas.charts) {
            const double count = double(c.nx) * double(c.ny);
            texels += count, widths += count * double(texel_width(c));
        }
        usual_width_ = texels > 0.0 ? float(widths / texels) : 0.0f;
    }
    /// width   of the point's texel; wide ones do not look farther for a cover than usual ones do
    bool over(const Vec3& point, const Vec3& normal, float width) const {
        const Vec3 above = point + kSightHeight * std::min(width, usual_width_) * normal;
        return !in_sight(rays_, RayScene::offset_origin(point, normal, normal), above);
    }
    /// Leaves lie on leaves everywhere: nothing of a tree is hidden for good.
    bool may_hide(std::uint32_t triangle) const {
        return rays_.scene().materials[rays_.mesh().materials[triangle]].alpha_mode == AlphaMode::Opaque;
    }

  private:
    const RayScene& rays_;
    float usual_width_ = 0.0f;  // metres
};

class Parter {
  public:
    Parter(const RayScene& rays, const Covers& covers, std::span<const TexelPoint> points, float width)
        : rays_(rays), covers_(covers), width_(width), may_hide_(covers.may_hide(points.front().triangle)) {
        for (const TexelPoint& p : points) {
            const Vec3 normal = geometric_normal(rays.mesh(), p.triangle);
            normal_ += normal;
            normals_.push_back(normal);
            points_.push_back(position(rays.mesh(), p));
            above_.push_back(points_.back() + kSightHeight * width * normal);
            middle_ += above_.back() / float(points.size());
        }
    }

    std::vector<int> groups() const {
        std::vector<int> of(above_.size(), 0);
        if (of.size() < 2 || !parted_at_all()) return of;
        std::iota(of.begin(), of.end(), 0);
        std::vector<bool> below(of.size());
        for (std::size_t i = 0; i < of.size(); ++i) below[i] = under(i);
        const auto join = [&](std::size_t a, std::size_t b) {
            std::replace(of.begin(), of.end(), std::max(of[a], of[b]), std::min(of[a], of[b]));
        };
        for (std::size_t a = 0; a < of.size(); ++a)
            for (std::size_t b = a + 1; b < of.size(); ++b)
                if (of[a] != of[b] && below[a] == below[b] && (below[a] || in_sight(rays_, above_[a], above_[b])))
                    join(a, b);
        return numbered(of, below);
    }

  private:
    bool under(std::size_t i) const { return may_hide_ && covers_.over(points_[i], normals_[i], width_); }

    /// Whether points are under something, or out of sight of each other: from the one in the middle to those that lie
    /// farthest out on four sides, since what parts a texel lies between.
    bool parted_at_all() const {
        const auto farthest = [&](const auto& value) {
            const auto less = [&](const Vec3& a, const Vec3& b) { return value(a) < value(b); };
            return std::size_t(std::max_element(above_.begin(), above_.end(), less) - above_.begin());
        };
        const std::size_t from = farthest([&](const Vec3& p) { return -glm::distance(p, middle_); });
        const bool below = under(from);
        const Frame frame(unit_or(normal_, Vec3(0, 1, 0)));
        for (const Vec3& side : {frame.x + frame.y, frame.x - frame.y, -frame.x + frame.y, -frame.x - frame.y}) {
            const std::size_t to = farthest([&](const Vec3& p) { return glm::dot(p - middle_, side); });
            if (under(to) != below || (!below && !in_sight(rays_, above_[from], above_[to]))) return true;
        }
        return false;
    }

    /// Groups in the open, and points under something, are numbered in the order of their first points. Those inside of
    /// something solid come last, apart from all others: a ray that slips out of there may meet another room's light.
    std::vector<int> numbered(const std::vector<int>& of, const std::vector<bool>& below) const {
        std::vector<int> number(of.size(), -1), result(of.size(), 0);
        int count = 0;
        for (std::size_t i = 0; i < of.size(); ++i)
            if (std::size_t(of[i]) == i && (below[i] || !buried(rays_, above_[i]))) number[i] = count++;
        for (std::size_t i = 0; i < of.size(); ++i)
            result[i] = number[std::size_t(of[i])] < 0 ? count : number[std::size_t(of[i])];
        return result;
    }

    const RayScene& rays_;
    const Covers& covers_;
    float width_;
    bool may_hide_;
    std::vector<Vec3> points_, normals_, above_;
    Vec3 middle_ = Vec3(0.0f), normal_ = Vec3(0.0f);
};

/// A texel, its point that is nearest to a place, the triangle that it lies on, and how far that is.
struct Candidate {
    std::uint32_t texel, triangle;
    Vec3 nearest;
    float away;
};

Candidate candidate(const WorldMesh& mesh, const Texels& texels, std::uint32_t texel, const Vec3& place) {
    Candidate best{texel, texels.points_of(texel).front().triangle, Vec3(0.0f), 1e30f};
    for (const TexelPoint& p : texels.points_of(texel)) {
        const Vec3 at = position(mesh, p);
        const float away = glm::distance(at, place);
        if (away < best.away) best = {texel, p.triangle, at, away};
    }
    return best;
}

/// By a texel's middle, in the plane of its nearest point: on what is curved the middle itself lies inside.
bool covered(const RayScene& rays, const Covers& covers, const Texels& texels, std::uint32_t texel) {
    const Candidate near = candidate(rays.mesh(), texels, texel, texels.position[texel]);
    if (!covers.may_hide(near.triangle)) return false;
    const Vec3 normal = geometric_normal(rays.mesh(), near.triangle);
    const Vec3 middle = texels.position[texel] + glm::dot(near.nearest - texels.position[texel], normal) * normal;
    return covers.over(middle, normal, texels.width[texel]);
}

void mark_parts(Texels& texels, std::uint32_t first) {
    texels.for_parts(first, [&](std::uint32_t part) { texels.walled[part] = 1; });
}

/// Marks texels that have parts, or whose middle is out of sight from a neighbouring one's.
void mark(const RayScene& rays, const Atlas& atlas, std::size_t chart, Texels& texels) {
    for (std::uint32_t cell = texels.first_cell[chart]; cell < texels.first_cell[chart + 1]; ++cell) {
        const std::uint32_t own = texels.texel_of_cell[cell];
        if (own == kNoTexel) continue;
        bool walled = texels.next_part[own] != kNoTexel;
        for_texels_around(atlas, texels, own, 1, [&](std::uint32_t other) {
            if (other > own && !in_sight(rays, texels.above(own), texels.above(other)))
                walled = true, mark_parts(texels, other);
        });
        if (walled) mark_parts(texels, own);
    }
}

}  // namespace

Texels make_parted_texels(const RayScene& rays, const Atlas& atlas) {
    const Covers covers(rays, atlas);
    Texels texels = make_texels(rays.mesh(), atlas, [&](std::span<const TexelPoint> points, float width) {
        return Parter(rays, covers, points, width).groups();
    });
    texels.walled.assign(texels.count(), 0);
    texels.covered.resize(texels.count());
    tbb::parallel_for(std::uint32_t(0), std::uint32_t(texels.count()),
                      [&](std::uint32_t t) { texels.covered[t] = covered(rays, covers, texels, t); });
    tbb::parallel_for(std::size_t(0), atlas.charts.size(),
                      [&](std::size_t chart) { mark(rays, atlas, chart, texels); });
    return texels;
}

std::uint32_t texel_in_sight(const RayScene& rays, const Atlas& atlas, const Texels& texels, std::uint32_t triangle,
                             const Vec2& barycentric, const Vec3& place, bool back) {
    const std::uint32_t nearest = texels.at(atlas, triangle, barycentric);
    if (nearest == kNoTexel || !texels.walled[nearest]) return nearest;
    const float height = (back ? -kSightHeight : kSightHeight) * texels.width[nearest];
    const Vec3 from = place + height * geometric_normal(rays.mesh(), triangle);
    const auto seen = [&](const Candidate& c) {
        return in_sight(rays, from, c.nearest + height * texels.normal[c.texel]);
    };
    if (seen(candidate(rays.mesh(), texels, nearest, place))) return nearest;
    std::array<Candidate, kMostCandidates> candidates;
    std::size_t count = 0;
    for_texels_around(atlas, texels, nearest, 1, [&](std::uint32_t first) {
        texels.for_parts(first, [&](std::uint32_t part) {
            if (part != nearest && count < candidates.size())
                candidates[count++] = candidate(rays.mesh(), texels, part, place);
        });
    });
    const auto found = std::span(candidates).first(count);
    std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
        return std::tie(a.away, a.texel) < std::tie(b.away, b.texel);
    });
    const auto first = std::find_if(found.begin(), found.end(), seen);
    return first != found.end() ? first->texel : nearest;
}

}  // namespace daylit
