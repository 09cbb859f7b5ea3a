#pragma once
// A small kit for building meshes: planar shapes, boxes, lathes, tubes, patches. Faces wind counter-clockwise seen from
// outside. Texture coordinates are metres: u along the first axis of the surface, v downwards.
#include <functional>
#include <span>

#include "content/level.h"

namespace daylit::content {

/// How a box's texture lies on its faces. World: v is down on walls (stone courses stay level). Grain: u follows the
/// box's longest side (planks and beams).
enum class Mapping { World, Grain };

class MeshBuilder {
  public:
    /// What follows is put into this material's part.
    MeshBuilder& material(int index);
    /// What follows is moved by this; replaces the previous one. Mirrored transforms are not allowed.
    MeshBuilder& at(const Mat4& transform);
    MeshBuilder& at(const Vec3& translation);

    /// Returns the index within the present material's part; position and normal are transformed.
    std::uint32_t vertex(const Vec3& position, const Vec3& normal, const Vec2& uv);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

    /// Flat faces, texture by dominant axis in local metres.
    void flat_triangle(const Vec3& a, const Vec3& b, const Vec3& c);
    void flat_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
    /// Convex polygon, fanned from the first corner.
    void flat_polygon(std::span<const Vec3> corners);
    /// Quad with its own texture rectangle in metres: a is at uv (0, height), b (width, height), c (width, 0), d (0,
    /// 0).
    void picture_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec2& size);

    void box(const Vec3& low, const Vec3& high, Mapping mapping = Mapping::World);
    /// Box with its edges cut at 45 degrees, `bevel` metres in from each face.
    void bevel_box(const Vec3& low, const Vec3& high, float bevel, Mapping mapping = Mapping::World);
    /// A straight beam of rectangular section between two points; `up` gives the side that `height` runs along.
    void beam(const Vec3& from, const Vec3& to, float width, float height, const Vec3& up = Vec3(0, 1, 0));

    /// Surface of revolution about +Y through the local origin. profile: (radius, y), from bottom to top along the
    /// outside (an inside run back down makes a vessel). Corners sharper than 40 degrees stay sharp.
    void lathe(std::span<const Vec2> profile, int segments);
    void sphere(const Vec3& centre, float radius, int segments);
    void cylinder(const Vec3& base, float radius, float height, int segments);
    /// Round tube along a path with a radius at each point, capped at both ends.
    void tube(std::span<const Vec3> path, std::span<const float> radii, int segments);
    void tube(std::span<const Vec3> path, float radius, int segments);
    /// Closed ring of round section about the axis +Y.
    void torus(const Vec3& centre, float ring_radius, float tube_radius, int ring_segments, int tube_segments);
    /// Smooth grid of (columns + 1) x (rows + 1) points; f(s, t) with s, t in [0,1]; normals by differences, turned so
    /// that the front is where df/ds x df/dt points. size: texture metres along s and t.
    void grid(int columns, int rows, const Vec2& size, const std::function<Vec3(float, float)>& f);
    /// Two closed outlines of the same number of points, joined by a flat-shaded band; front is on the left of the walk
    /// along `near` seen with `far` ahead. smooth_degrees: joints below this angle are shaded smooth.
    void band(std::span<const Vec3> near, std::span<const Vec3> far, bool closed, float smooth_degrees = 30.0f);
    /// Bicubic Bezier patch of 16 control points, row by row.
    void bezier_patch(std::span<const Vec3, 16> points, int divisions);

    /// Everything so far, as one mesh; the builder is empty afterwards.
    LevelMesh take(const std::string& name);
    Geometry& part() { return mesh_.parts[material_]; }

  private:
    void flat_fan(std::span<const Vec3> corners, const std::function<Vec2(const Vec3&)>& uv);
    LevelMesh mesh_;
    int material_ = 0;
    Mat4 transform_ = Mat4(1.0f);
    Mat3 normal_transform_ = Mat3(1.0f);
};

/// Texture coordinates in metres of a point on a face with this normal: walls along x or z and down, floors along x, z.
Vec2 world_uv(const Vec3& position, const Vec3& normal);

Mat4 placed(const Vec3& translation, float yaw = 0.0f, float scale = 1.0f);

}  // namespace daylit::content
