#pragma once
// Which places can be reached without passing through a surface.
#include <vector>

#include "gi/trace/line_of_sight.h"

namespace daylit {

/// A grid of cells over the scene; from where light or feet start, free space spreads from centre to centre.
class FreeSpace {
  public:
    /// cells   along the longest side of the scene's box
    explicit FreeSpace(const RayScene& rays, int cells = 64);

    const Bounds& box() const { return box_; }
    /// From a place outside of the box space starts at what it sees of the box's border.
    void start_at(const Vec3& place);
    /// At all cells from whose centres the sky is seen straight above.
    void start_under_the_sky();
    void spread();
    /// Whether nothing lies between this place and the centre of a reached cell: its own or one beside it. False
    /// outside of the box; its border is inside.
    bool reachable(const Vec3& place) const;
    /// Share of reached cells among those that a box overlaps.
    double reached_share(const Bounds& box) const;
    bool buried(const Vec3& place) const { return daylit::buried(rays_, place); }
    bool open(const Vec3& from, const Vec3& to) const { return in_sight(rays_, from, to); }

  private:
    glm::ivec3 cell_of(const Vec3& place) const { return glm::ivec3(glm::floor((place - box_.min) / cell_)); }
    Vec3 centre(const glm::ivec3& cell) const { return box_.min + (Vec3(cell) + 0.5f) * cell_; }
    bool inside(const glm::ivec3& cell) const;
    std::size_t index(const glm::ivec3& cell) const;
    bool reachable_from(const glm::ivec3& cell, const Vec3& place) const;
    void reach(const glm::ivec3& cell);

    const RayScene& rays_;
    Bounds box_;
    float cell_ = 1.0f;  // metres
    glm::ivec3 counts_ = glm::ivec3(1);
    std::vector<bool> reached_;
    std::vector<glm::ivec3> front_;
};

}  // namespace daylit
