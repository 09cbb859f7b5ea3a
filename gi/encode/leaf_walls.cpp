#include "gi/encode/leaf_walls.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace daylit {
namespace {

int side_of(const Vec4& plane, const Vec3& place) {
    return glm::dot(Vec3(plane), place) + plane.w >= 0.0f ? 0 : 1;
}

class SideFinder {
  public:
    SideFinder(const std::array<Vec3, kLeafPlaces>& places, const std::array<bool, kLeafPlaces>& free,
               const RayScene& rays, const FreeSpace& space)
        : places_(places), free_(free), rays_(rays), space_(space) {}

    LeafSides find() {
        group();
        const std::size_t groups = count_groups();
        const bool parted = groups > 1 && part(groups);
        out_.mixed = groups > 1 && !parted;
        for (std::size_t p = 0; p < kLeafPlaces; ++p)
            out_.side[p] = std::int8_t(!free_[p] ? -1 : out_.plane ? side_of(*out_.plane, places_[p]) : 0);
        if (out_.plane && !parted) drop_minorities();
        return out_;
    }

  private:
    void group() {
        std::iota(of_.begin(), of_.end(), 0);
        for (int p = 0; p < kLeafPlaces; ++p)
            for (const auto& [stride, last] :
                 {std::pair(1, p % 3 == 2), std::pair(3, p / 3 % 3 == 2), std::pair(9, p / 9 == 2)})
                if (!last) join(std::size_t(p), std::size_t(p + stride));
    }

    void join(std::size_t p, std::size_t q) {
        if (!free_[p] || !free_[q]) return;
        if (!space_.open(places_[p], places_[q]))
            blocked_.emplace_back(p, q);
        else if (of_[p] != of_[q])
            std::replace(of_.begin(), of_.end(), std::max(of_[p], of_[q]), std::min(of_[p], of_[q]));
    }

    std::size_t count_groups() const {
        std::map<int, int> sizes;
        for (std::size_t p = 0; p < kLeafPlaces; ++p)
            if (free_[p]) ++sizes[of_[p]];
        return sizes.size();
    }

    /// The plane of a wall between blocked neighbours that parts the groups best; whether there are two, and parted.
    bool part(std::size_t groups) {
        int best = 0;
        for (const auto& [p, q] : blocked_) {
            if (of_[p] == of_[q]) continue;
            const Vec3 &a = places_[p], &b = places_[q];
            const Vec3 along = glm::normalize(b - a);
            const float length = glm::distance(a, b);
            const auto from_a = rays_.closest({a, along, 0.0f, length}, 0),
                       from_b = rays_.closest({b, -along, 0.0f, length}, 0);
            if (!from_a || !from_b) continue;
            const Vec3 middle = 0.5f * (a + from_a->distance * along + b - from_b->distance * along);
            for (const Vec3& hit_normal : {from_a->normal, from_b->normal}) {
                const Vec3 normal = glm::dot(hit_normal, along) > 0.0f ? -hit_normal : hit_normal;
                const Vec4 plane(normal, -glm::dot(normal, middle));
                const auto [right, wrong] = parted(plane);
                if (wrong == 0 && groups == 2) {
                    out_.plane = plane;
                    return true;
                }
                if (right - wrong > best) best = right - wrong, out_.plane = plane;
            }
        }
        return false;
    }

    /// Places on the side where most of their group is, and those that are not.
    std::pair<int, int> parted(const Vec4& plane) const {
        std::map<int, std::array<int, 2>> counts;
        for (std::size_t p = 0; p < kLeafPlaces; ++p)
            if (free_[p]) ++counts[of_[p]][std::size_t(side_of(plane, places_[p]))];
        int right = 0, wrong = 0;
        std::array<bool, 2> any{};
        for (const auto& [g, count] : counts) {
            right += std::max(count[0], count[1]), wrong += std::min(count[0], count[1]);
            any[count[1] > count[0] ? 1 : 0] = true;
        }
        return any[0] && any[1] ? std::pair(right, wrong) : std::pair(0, kLeafPlaces);
    }

    /// Of either side only the largest group tells of its light.
    void drop_minorities() {
        for (int side = 0; side < 2; ++side) {
            std::map<int, int> sizes;
            for (std::size_t p = 0; p < kLeafPlaces; ++p)
                if (out_.side[p] == side) ++sizes[of_[p]];
            const auto largest = std::max_element(sizes.begin(), sizes.end(),
                                                  [](const auto& a, const auto& b) { return a.second < b.second; });
            for (std::size_t p = 0; p < kLeafPlaces; ++p)
                if (out_.side[p] == side && of_[p] != largest->first) out_.side[p] = -1;
        }
    }

    const std::array<Vec3, kLeafPlaces>& places_;
    const std::array<bool, kLeafPlaces>& free_;
    const RayScene& rays_;
    const FreeSpace& space_;
    LeafSides out_;
    std::array<int, kLeafPlaces> of_{};  // the group of each place
    std::vector<std::pair<std::size_t, std::size_t>> blocked_;
};

/// Of the way from a place in a box to another; 1 where it starts outside.
float share_inside(const Bounds& box, const Vec3& from, const Vec3& to) {
    float share = 1.0f;
    for (int a = 0; a < 3; ++a) {
        if (box.empty() || from[a] < box.min[a] || from[a] > box.max[a]) return 1.0f;
        if (to[a] < box.min[a]) share = std::min(share, (box.min[a] - from[a]) / (to[a] - from[a]));
        if (to[a] > box.max[a]) share = std::min(share, (box.max[a] - from[a]) / (to[a] - from[a]));
    }
    return share;
}

}  // namespace

LeafSides find_sides(const std::array<Vec3, kLeafPlaces>& places, const std::array<bool, kLeafPlaces>& free,
                     const RayScene& rays, const FreeSpace& space) {
    return SideFinder(places, free, rays, space).find();
}

std::optional<Vec3> before_wall(const RayScene& rays, const Bounds& box, const Vec3& from, const Vec3& to,
                                float before) {
    const float length = glm::distance(from, to);
    const Vec3 along = (to - from) / length;
    const std::optional<Hit> met = rays.closest({from, along, 0.0f, length}, 0);
    const float end = std::min(met ? met->distance : length, length * share_inside(box, from, to));
    if (!met && end >= length) return std::nullopt;
    return from + (end - std::min(before, 0.5f * end)) * along;
}

}  // namespace daylit
