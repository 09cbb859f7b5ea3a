#pragma once
// A camera that stays upright: where it stands and where it looks.
#include <string>

#include "engine/scene/pose.h"

namespace daylit {

struct Gaze {
    Vec3 eye = Vec3(0.0f);
    float yaw = 0.0f;              // radians, counter-clockwise seen from above; 0 looks along -Z
    float pitch = 0.0f;            // radians upwards, short of the zenith
    float vertical_fov = 1.0472f;  // radians
};

inline constexpr float kSteepestPitch = 1.55f;

/// Roll is dropped; an orthographic camera gets 60 degrees.
Gaze gaze_from_view(const View& view);
View view_from_gaze(const Gaze& gaze);

/// The options of shot that take the same picture: "--eye x,y,z --at x,y,z --fov D".
std::string shot_options(const Gaze& gaze);

struct Bookmark {
    std::string name;
    Gaze gaze;
};

}  // namespace daylit
