#pragma once
// Where on a receiver straight light is asked for.
#include <algorithm>
#include <array>

#include "gi/transport/day_gather/day_gather.h"

namespace daylit {

struct Place {
    Vec3 position, normal;  // unit, on the receiver's side
};

/// The usable points of a receiver.
class UsablePoints {
  public:
    UsablePoints(const GatherScene& scene, const GatherHits& hits, std::size_t receiver) {
        const Receiver r = hits.receivers[receiver];
        const auto points = scene.texels.points_of(r.texel);
        for (std::size_t k = 0; k < std::min(points.size(), places_.size()); ++k) {
            if (!(hits.usable[receiver] >> k & 1u)) continue;
            const Vec3 n = geometric_normal(scene.rays.mesh(), points[k].triangle);
            places_[count_++] = {position(scene.rays.mesh(), points[k]), r.back ? -n : n};
        }
    }
    bool empty() const { return count_ == 0; }
    const Place& any(float u) const { return places_[std::min(std::size_t(u * float(count_)), count_ - 1)]; }

  private:
    std::array<Place, 16> places_;
    std::size_t count_ = 0;
};

}  // namespace daylit
