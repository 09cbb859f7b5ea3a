#pragma once
// How wrong a leaf's corners are about the light inside of it, and how much that matters.
#include "gi/encode/volume_refine.h"

namespace daylit {

/// Errors above this many times the target count no more: a wall inside of the cell.
inline constexpr double kOutlier = 4.0;

struct LeafError {
    double worst = 0.0;   // over the target; 1 and less: well enough
    double square = 0.0;  // mean square error, over the light, times the free space of the cell and what it counts
};

class LeafJudge {
  public:
    /// Everything handed over must outlive this.
    LeafJudge(const RefinedVolume& volume, const FreeSpace& space, const std::vector<Bounds>& regions,
              const VolumeSettings& settings)
        : volume_(volume), space_(space), regions_(regions), settings_(settings) {}

    /// A sample more of the volume, whose mean light errors are compared with.
    void add_to_mean(const VolumeSample& sample);
    /// mixed   places of the leaf that do not see each other are on one side
    LeafError judge(const Octree::Node& node, const RefinedLeaf& leaf, bool mixed) const;

  private:
    struct StandIn;
    struct SideError;

    LeafError unseen(const Octree::Node& node) const;
    bool counts(const Vec3& place) const;
    double free_share(const Octree::Node& n) const;
    double enclosed(const RefinedLeaf& leaf) const;
    double moving_share(const Octree::Node& n) const;
    SideError side_error(const RefinedLeaf& leaf, const Octree::Node& node, int side) const;
    void compare(const std::array<StandIn, 8>& corners, float length, const VolumeSample& measured, const Vec3& t,
                 SideError& result) const;
    double interpolated(const std::array<StandIn, 8>& corners, std::size_t f, const Vec3& t, float length) const;
    double by_controls(const VolumeSample& s, float length) const;
    StandIn stand_in(const RefinedLeaf& leaf, int corner, int side) const;

    const RefinedVolume& volume_;
    const FreeSpace& space_;
    const std::vector<Bounds>& regions_;
    const VolumeSettings& settings_;
    std::vector<double> mean_;  // sums over samples
};

}  // namespace daylit
