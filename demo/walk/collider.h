#pragma once
// The level's triangles as the walk bumps into them: boxes of triangles in a tree, and the distance of a standing
// capsule to them. No GL, no Embree.
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/scene/pose.h"

namespace daylit {

/// An upright capsule: all points within `radius` of the segment between two heights over (x, z).
struct Capsule {
    Vec3 bottom = Vec3(0.0f);  // centre of the lower sphere
    float height = 1.0f;       // of the upper sphere's centre over it, metres
    float radius = 0.3f;
};

struct Contact {
    float depth = 0.0f;         // metres that the capsule reaches into the triangle
    Vec3 away = Vec3(0, 1, 0);  // unit, from the triangle to the capsule's axis: the shortest way out
};

/// Immutable. Triangles block from both sides; those of zero area or with numbers that are not finite are left out.
class Collider {
  public:
    explicit Collider(const WorldMesh& mesh);

    /// The deepest contact of the capsule with any triangle, if any.
    std::optional<Contact> deepest_contact(const Capsule& capsule) const;

    /// Height of the highest surface no steeper than a floor (see kFloorCosine) in [below, above] at (x, z).
    std::optional<float> floor_height(float x, float z, float below, float above) const;

    const Bounds& bounds() const { return bounds_; }
    bool empty() const { return triangles_.empty(); }

  private:
    struct Triangle {
        Vec3 a, b, c;
    };
    struct Node {
        Bounds box;
        std::uint32_t first = 0, count = 0;  // of triangles; count 0: inner node
        std::uint32_t second_child = 0;      // the first child follows its parent
    };
    void build(std::uint32_t first, std::uint32_t count);
    template <typename Visit>
    void visit(const Bounds& box, const Visit& per_triangle) const;

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
    Bounds bounds_;
};

/// Surfaces tilted less than 50 degrees carry a walker.
inline constexpr float kFloorCosine = 0.6428f;

}  // namespace daylit
