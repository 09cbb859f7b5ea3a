#pragma once
// Walls are often cut where their neighbours are not: the parts touch along pieces of edges and share none whole.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gi/surface/charts.h"

namespace daylit {

/// A side of a triangle, from its corner `side` to the next.
struct TriangleSide {
    std::uint32_t triangle = 0, side = 0;
};

/// Pairs of triangles in one plane that face alike and lie on either side of a line along which these sides of theirs
/// touch, sorted. Where hundreds of sides crowd into one place, none of them is looked at.
std::vector<std::array<std::uint32_t, 2>> touching(const WorldMesh& mesh, std::span<const Facet> facets,
                                                   std::span<const TriangleSide> sides);

}  // namespace daylit
