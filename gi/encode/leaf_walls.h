#pragma once
// Walls inside of a volume's leaf: which of its places see each other, what parts them, and where just before a wall
// light can still be sampled.
#include <array>
#include <cstdint>
#include <optional>

#include "gi/surface/free_space.h"

namespace daylit {

/// The 27 places of a leaf, x fastest: corners, middles of edges and faces, the centre.
inline constexpr int kLeafPlaces = 27;

/// Where in the leaf a place is, [0, 1].
inline Vec3 t_of(int place) {
    return 0.5f * Vec3(place % 3, place / 3 % 3, place / 9);
}
inline bool is_corner(int place) {
    return place % 3 != 1 && place / 3 % 3 != 1 && place / 9 != 1;
}

/// Which side of a wall each of a leaf's places is on.
struct LeafSides {
    std::array<std::int8_t, kLeafPlaces> side{};  // -1: of no cell; 0: of the leaf or its front; 1: of its back
    std::optional<Vec4> plane;                    // of the wall: in front where dot(xyz, place) + w >= 0, metres
    bool mixed = false;                           // places that do not see each other are on one side
};

/// Groups the free places by what neighbours see each other. Two groups are parted by a plane; of more, either side of
/// the best plane keeps the places of its largest group.
LeafSides find_sides(const std::array<Vec3, kLeafPlaces>& places, const std::array<bool, kLeafPlaces>& free,
                     const RayScene& rays, const FreeSpace& space);

/// On the way from one place to another, at most `before` metres before what is met first: a surface, or the end of the
/// scene's box. None when nothing is.
std::optional<Vec3> before_wall(const RayScene& rays, const Bounds& box, const Vec3& from, const Vec3& to,
                                float before);

}  // namespace daylit
