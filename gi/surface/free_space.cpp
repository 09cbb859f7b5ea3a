#include "gi/surface/free_space.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

constexpr float kTouching = 1e-3f;  // cells

}  // namespace

FreeSpace::FreeSpace(const RayScene& rays, int cells) : rays_(rays), box_(rays.bounds()) {
    if (box_.empty()) {
        counts_ = glm::ivec3(0);
        return;
    }
    const Vec3 size = box_.max - box_.min;
    cell_ = std::max({size.x, size.y, size.z}) / float(cells);
    for (int axis = 0; axis < 3; ++axis) counts_[axis] = std::max(1, int(std::ceil(size[axis] / cell_)));
    reached_.resize(std::size_t(counts_.x) * std::size_t(counts_.y) * std::size_t(counts_.z), false);
}

void FreeSpace::start_at(const Vec3& place) {
    const glm::ivec3 cell = cell_of(place);
    if (inside(cell)) {
        if (open(place, centre(cell))) reach(cell);
        return;
    }
    // From outside of the box, through whichever cells at its border are seen.
    for (int z = 0; z < counts_.z; ++z)
        for (int y = 0; y < counts_.y; ++y)
            for (int x = 0; x < counts_.x; ++x) {
                const glm::ivec3 at(x, y, z);
                const bool border = glm::any(glm::equal(at, glm::ivec3(0))) || glm::any(glm::equal(at, counts_ - 1));
                if (border && open(place, centre(at))) reach(at);
            }
}

void FreeSpace::start_under_the_sky() {
    for (int z = 0; z < counts_.z; ++z)
        for (int y = 0; y < counts_.y; ++y)
            for (int x = 0; x < counts_.x; ++x)
                if (rays_.transmittance({centre({x, y, z}), Vec3(0, 1, 0)}) == 1.0f) reach({x, y, z});
}

void FreeSpace::spread() {
    while (!front_.empty()) {
        const glm::ivec3 cell = front_.back();
        front_.pop_back();
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 next = cell;
                next[axis] += step;
                if (inside(next) && !reached_[index(next)] && open(centre(cell), centre(next))) reach(next);
            }
    }
}

bool FreeSpace::reachable(const Vec3& place) const {
    glm::ivec3 own = cell_of(place);
    // The border belongs to the cells behind it, wherever rounding has put a place on it.
    for (int axis = 0; axis < 3; ++axis) {
        const float beyond = std::max(place[axis] - box_.max[axis], box_.min[axis] - place[axis]);
        if (beyond <= kTouching * cell_) own[axis] = std::clamp(own[axis], 0, counts_[axis] - 1);
    }
    if (!inside(own)) return false;
    if (reachable_from(own, place)) return true;
    // The own cell's centre may lie behind a surface that this place is before.
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if ((x != 0 || y != 0 || z != 0) && reachable_from(own + glm::ivec3(x, y, z), place)) return true;
    return false;
}

bool FreeSpace::reachable_from(const glm::ivec3& cell, const Vec3& place) const {
    if (!inside(cell) || !reached_[index(cell)]) return false;
    // A little further on, since a place on a surface, where half of what is seen lies behind it, is not free.
    const Vec3 along = place - centre(cell);
    const float distance = glm::length(along);
    return distance == 0.0f || open(centre(cell), place + kTouching * cell_ / distance * along);
}

double FreeSpace::reached_share(const Bounds& box) const {
    const glm::ivec3 first = glm::max(cell_of(box.min), glm::ivec3(0)), last = glm::min(cell_of(box.max), counts_ - 1);
    long all = 0, reached = 0;
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) ++all, reached += reached_[index({x, y, z})];
    return all > 0 ? double(reached) / double(all) : 0.0;
}

bool FreeSpace::inside(const glm::ivec3& cell) const {
    return glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) && glm::all(glm::lessThan(cell, counts_));
}

std::size_t FreeSpace::index(const glm::ivec3& cell) const {
    return (std::size_t(cell.z) * std::size_t(counts_.y) + std::size_t(cell.y)) * std::size_t(counts_.x) +
           std::size_t(cell.x);
}

void FreeSpace::reach(const glm::ivec3& cell) {
    if (reached_[index(cell)]) return;
    reached_[index(cell)] = true;
    front_.push_back(cell);
}

}  // namespace daylit
