#include "demo/walk/gaze.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace daylit {
namespace {

Vec3 direction(const Gaze& gaze) {
    return {-std::sin(gaze.yaw) * std::cos(gaze.pitch), std::sin(gaze.pitch),
            -std::cos(gaze.yaw) * std::cos(gaze.pitch)};
}

}  // namespace

Gaze gaze_from_view(const View& view) {
    const Mat4& m = view.view_from_world;
    const Vec3 ahead = -glm::normalize(Vec3(m[0][2], m[1][2], m[2][2]));
    Gaze gaze;
    gaze.eye = view.eye;
    gaze.pitch = std::clamp(std::asin(std::clamp(ahead.y, -1.0f, 1.0f)), -kSteepestPitch, kSteepestPitch);
    // Straight up or down the camera's own top says which way it faces.
    const Vec3 facing = std::abs(ahead.y) < 0.999f ? ahead : Vec3(m[0][1], 0, m[2][1]) * (ahead.y > 0 ? -1.0f : 1.0f);
    gaze.yaw = std::atan2(-facing.x, -facing.z);
    if (!view.orthographic) gaze.vertical_fov = view.vertical_fov;
    return gaze;
}

View view_from_gaze(const Gaze& gaze) {
    return look_at(gaze.eye, gaze.eye + direction(gaze), gaze.vertical_fov);
}

std::string shot_options(const Gaze& gaze) {
    const Vec3 at = gaze.eye + direction(gaze);
    char text[160];
    std::snprintf(text, sizeof text, "--eye %.3f,%.3f,%.3f --at %.3f,%.3f,%.3f --fov %.1f", double(gaze.eye.x),
                  double(gaze.eye.y), double(gaze.eye.z), double(at.x), double(at.y), double(at.z),
                  double(gaze.vertical_fov) / kDegree);
    return text;
}

}  // namespace daylit
