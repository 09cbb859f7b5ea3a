#pragma once
// Charts: pieces of surface flat enough to be drawn on a plane.
#include <cstdint>
#include <span>
#include <vector>

#include "engine/scene/pose.h"
#include "gi/surface/surroundings.h"

namespace daylit {

/// Connected triangles whose normals lie within 37 degrees of one another's seed, seen along that seed's normal; those
/// of one plane may touch along pieces of edges, others share edges whole, along which shading is smooth. No two of
/// them cover the same place of the plane.
struct Chart {
    std::vector<std::uint32_t> triangles;                  // of the WorldMesh
    Vec3 origin = Vec3(0.0f);                              // world position of (0, 0) of the plane
    Vec3 axis_u = Vec3(1, 0, 0), axis_v = Vec3(0, 0, -1);  // unit, world; axis_u x axis_v is the seed's normal
    Vec2 size = Vec2(0.0f);                                // metres; the triangles project to [0, size]

    Vec2 project(const Vec3& p) const { return {glm::dot(p - origin, axis_u), glm::dot(p - origin, axis_v)}; }
};

/// Every triangle of positive area that is not left out has one chart; charts are turned to fill their rectangles well.
/// grain     metres: overlaps narrower than this may go unseen
/// around    per triangle, or empty: what is hidden stays out, but for small pieces; out of the seed's plane also what
///           is much nearer to its surroundings
/// left_out  per triangle, or empty: those that get no chart
std::vector<Chart> grow_charts(const WorldMesh& mesh, float grain, std::span<const Surroundings> around = {},
                               const std::vector<bool>& left_out = {});

/// For each triangle the number of the piece of surface that it is on: pieces end at creases and open edges.
std::vector<std::uint32_t> smooth_pieces(const WorldMesh& mesh);

/// Area of a triangle in square metres and its unit normal by winding; zero and (0,0,0) when it has none.
struct Facet {
    float area = 0.0f;
    Vec3 normal = Vec3(0.0f);
};
std::vector<Facet> facets(const WorldMesh& mesh);

}  // namespace daylit
