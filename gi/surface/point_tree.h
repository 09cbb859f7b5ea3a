#pragma once
// What lies near a place.
#include <nanoflann.hpp>
#include <vector>

#include "engine/base/units.h"

namespace daylit {

struct PointCloud {
    const std::vector<Vec3>& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][int(axis)]; }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};
using PointTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, PointCloud>, PointCloud, 3, std::uint32_t>;
inline const nanoflann::KDTreeSingleIndexAdaptorParams kPointsOfLeaf(16);

}  // namespace daylit
