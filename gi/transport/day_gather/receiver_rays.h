#pragma once
// Where a receiver's gather rays start and where they go: the same each time they are asked for, so that directions
// need not be kept beside the hits.
#include <algorithm>
#include <array>

#include "engine/base/random.h"
#include "gi/transport/day_gather/day_gather.h"
#include "gi/transport/day_gather/sequence.h"

namespace daylit {

class ReceiverRays {
  public:
    static constexpr std::size_t kMostPoints = 16;

    /// round   0, or further rays than the first
    ReceiverRays(const GatherScene& scene, const GatherSettings& settings, const Receiver& receiver, int round = 0)
        : random_(settings.seed, 2 * std::uint64_t(receiver.texel) + receiver.back, std::uint64_t(round)),
          rays_(settings.rays) {
        for (const TexelPoint& p : scene.texels.points_of(receiver.texel)) {
            if (count_ == kMostPoints) break;
            const Vec3 n = geometric_normal(scene.rays.mesh(), p.triangle);
            position_[count_] = position(scene.rays.mesh(), p);
            normal_[count_++] = receiver.back ? -n : n;
        }
        turn_.x = random_.next(), turn_.y = random_.next();
        turns_ = random_.bits();
    }

    std::size_t points() const { return count_; }
    const Vec3& position_of(std::size_t point) const { return position_[point]; }
    const Vec3& normal_of(std::size_t point) const { return normal_[point]; }  // unit, on the receiver's side

    /// The point that ray j starts at. Each block of rays goes through all points, shifted by chance from block to
    /// block: a regular shift and the radical inverse would keep every point to a few bands of azimuths.
    std::size_t point_of(int j) const {
        const std::size_t block = std::size_t(j) / count_;
        return (std::size_t(j) + (mix64(turns_ ^ block) >> 32)) % count_;
    }

    /// Unit; over all rays distributed as the cosine with the point's normal.
    Vec3 direction(int j) const {
        const Vec2 u(fraction((float(j) + 0.5f) / float(rays_) + turn_.x),
                     fraction(radical_inverse(std::uint32_t(j)) + turn_.y));
        return Frame(normal_[point_of(j)]).to_world(sample_cosine_hemisphere(u.x, u.y));
    }

    /// Further numbers of the receiver's own.
    Random& random() { return random_; }

  private:
    Random random_;
    int rays_;
    Vec2 turn_;
    std::uint64_t turns_ = 0;
    std::size_t count_ = 0;
    std::array<Vec3, kMostPoints> position_, normal_;
};

}  // namespace daylit
