// Cameras: from glTF nodes, from a place and a target, and the two sides of one projection (rays and clip space).
#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/scene/pose.h"

namespace daylit {
namespace {

/// view_from_world of a camera at `eye` with these orthonormal axes (right, up, backward).
Mat4 view_matrix(const Vec3& eye, const Vec3& right, const Vec3& up, const Vec3& backward) {
    Mat4 view(1.0f);
    for (int c = 0; c < 3; ++c) view[c] = Vec4(right[c], up[c], backward[c], 0.0f);
    view[3] = Vec4(-glm::dot(right, eye), -glm::dot(up, eye), -glm::dot(backward, eye), 1.0f);
    return view;
}

/// Axes for a camera that looks backwards along `backward`, its picture's top towards `up_hint`.
Mat4 upright_view(const Vec3& eye, const Vec3& backward, const Vec3& up_hint) {
    const Vec3 right = glm::normalize(glm::cross(up_hint, backward));
    return view_matrix(eye, right, glm::cross(backward, right), backward);
}

}  // namespace

View camera_view(const Scene& scene, const Pose& pose, const std::string& name) {
    std::string names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name != name) {
            names += (names.empty() ? "" : ", ") + camera.name;
            continue;
        }
        // The node's scale takes no part in what the camera sees.
        const Mat4& world = pose.world_from_node[std::size_t(camera.node)];
        View view;
        view.eye = Vec3(world[3]);
        const Vec3 backward = Vec3(glm::normalize(glm::dvec3(world[2])));
        view.view_from_world = upright_view(view.eye, backward, Vec3(glm::normalize(glm::dvec3(world[1]))));
        view.vertical_fov = camera.vertical_fov;
        view.orthographic = camera.orthographic;
        view.height = camera.height;
        view.z_near = camera.z_near;
        return view;
    }
    throw Error("--camera", "no camera '" + name + "' in " + scene.path.filename().string() +
                                (names.empty() ? ", which has none; give --eye and --at" : "; there are " + names));
}

View look_at(const Vec3& eye, const Vec3& at, float vertical_fov) {
    const Vec3 away = eye - at;
    const float distance = glm::length(away);
    if (!(distance > 0)) throw Error("--at", "is the same point as --eye; a view needs a direction");
    const Vec3 backward = away / distance;
    // Straight up or down, north is at the picture's top.
    const bool vertical = std::abs(backward.y) > 0.9999f;
    View view;
    view.eye = eye;
    view.view_from_world = upright_view(eye, backward, vertical ? Vec3(0, 0, -1) : Vec3(0, 1, 0));
    view.vertical_fov = vertical_fov;
    return view;
}

View overview(const Bounds& bounds) {
    const Bounds box = bounds.empty() ? Bounds{Vec3(-1), Vec3(1)} : bounds;
    const Vec3 centre = 0.5f * (box.min + box.max);
    const float radius = std::max(0.5f * glm::length(box.max - box.min), 1e-3f);
    constexpr float kFov = 0.9f;
    // From the south-east, a third of the way up: far enough for the bounding sphere to fit.
    const Vec3 direction = glm::normalize(Vec3(0.6f, 0.55f, 0.8f));
    View view = look_at(centre + direction * (radius / std::sin(0.5f * kFov)), centre, kFov);
    view.z_near = std::max(1e-4f * radius, 1e-4f);
    return view;
}

ViewRays::ViewRays(const View& view, int width, int height)
    : world_from_view_(glm::transpose(Mat3(view.view_from_world))),
      eye_(view.eye),
      orthographic_(view.orthographic),
      width_(float(width)),
      height_(float(height)) {
    const float half = orthographic_ ? 0.5f * view.height : std::tan(0.5f * view.vertical_fov);
    half_ = Vec2(width_ / height_ * half, half);
}

ViewRay ViewRays::at(float x, float y) const {
    const Vec2 on_plane = Vec2(2.0f * x / width_ - 1.0f, 1.0f - 2.0f * y / height_) * half_;
    if (orthographic_) return {eye_ + world_from_view_ * Vec3(on_plane, 0.0f), world_from_view_ * Vec3(0, 0, -1)};
    return {eye_, glm::normalize(world_from_view_ * Vec3(on_plane, -1.0f))};
}

ViewRay view_ray(const View& view, float x, float y, int width, int height) {
    return ViewRays(view, width, height).at(x, y);
}

Mat4 projection(const View& view, int width, int height) {
    const float aspect = float(width) / float(height);
    Mat4 clip(0.0f);
    if (view.orthographic) {
        // Depth falls linearly from 1 at the near plane; the far end is so distant that nothing lies behind it.
        constexpr float kFar = 1.0e5f;
        clip[0][0] = 2.0f / (view.height * aspect);
        clip[1][1] = 2.0f / view.height;
        clip[2][2] = 1.0f / (kFar - view.z_near);
        clip[3][2] = kFar / (kFar - view.z_near);
        clip[3][3] = 1.0f;
        return clip;
    }
    const float focal = 1.0f / std::tan(0.5f * view.vertical_fov);
    clip[0][0] = focal / aspect;
    clip[1][1] = focal;
    clip[2][3] = -1.0f;
    clip[3][2] = view.z_near;
    return clip;
}

}  // namespace daylit
