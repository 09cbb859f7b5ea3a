// The capsule ends a step's height over the feet, so that curbs and stairs never block it; the feet follow the floor
// that is found under it. What remains are walls and ceilings, out of which the capsule is pushed the shortest way.
#include "demo/walk/walker.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

constexpr float kGravity = 9.81f;   // m/s^2
constexpr float kWalkSpeed = 2.2f;  // m/s
constexpr float kRunSpeed = 5.5f;
constexpr float kFlySpeed = 4.0f;
constexpr float kFastFlySpeed = 16.0f;
constexpr float kJumpSpeed = 4.2f;     // carries 0.9 m up
constexpr float kFallLimit = 50.0f;    // m/s
constexpr float kStartUpTime = 0.08f;  // seconds to come near the speed asked for
constexpr float kAirControlTime = 0.6f;
constexpr float kStepSmoothing = 0.09f;  // seconds in which the camera follows the feet
constexpr float kStorey = 4.0f;          // metres
constexpr float kSkin = 0.001f;          // kept clear of walls
constexpr int kPushes = 8;

Vec3 ahead(float yaw) {
    return {-std::sin(yaw), 0, -std::cos(yaw)};
}
Vec3 to_the_right(float yaw) {
    return {std::cos(yaw), 0, -std::sin(yaw)};
}

Vec3 limited(const Vec3& v) {
    const float length = glm::length(v);
    return length > 1 ? v / length : v;
}

/// Share of the way to a goal that a lag with this time constant covers in `seconds`.
float approach(float seconds, float time) {
    return 1.0f - std::exp(-seconds / time);
}

}  // namespace

Walker::Walker(const Collider& level, const Vec3& eye) : level_(level) {
    place(eye);
}

void Walker::place(const Vec3& eye) {
    start_ = eye;
    feet_ = eye - Vec3(0, shape_.eye, 0);
    velocity_ = Vec3(0.0f);
    eye_lag_ = 0;
    const std::optional<float> floor = level_.floor_height(eye.x, eye.z, feet_.y - kStorey, eye.y);
    flying_ = !floor;
    on_floor_ = false;
    if (!floor) return;
    feet_.y = std::max(feet_.y, *floor);
    on_floor_ = feet_.y - *floor < kSkin;
}

void Walker::fly(bool on) {
    flying_ = on;
    velocity_ = Vec3(0.0f);
    on_floor_ = false;
}

Vec3 Walker::eye() const {
    return feet_ + Vec3(0, shape_.eye - eye_lag_, 0);
}

Capsule Walker::capsule(const Vec3& feet) const {
    const float bottom = shape_.step + shape_.radius, top = shape_.stature - shape_.radius;
    return {feet + Vec3(0, bottom, 0), top - bottom, shape_.radius};
}

void Walker::advance(const Steering& steering, float seconds) {
    const float time = std::clamp(seconds, 0.0f, 0.25f);
    if (time == 0) return;
    flying_ ? advance_flight(steering, time) : advance_walk(steering, time);
    eye_lag_ *= std::exp(-time / kStepSmoothing);
}

// Through walls: flying is for looking at things from where nobody can stand.
void Walker::advance_flight(const Steering& steering, float seconds) {
    const Vec3 gaze = ahead(steering.yaw) * std::cos(steering.pitch) + Vec3(0, std::sin(steering.pitch), 0);
    const Vec3 wish =
        limited(gaze * steering.move.z + to_the_right(steering.yaw) * steering.move.x + Vec3(0, steering.move.y, 0));
    const Vec3 goal = wish * (steering.run ? kFastFlySpeed : kFlySpeed);
    velocity_ += (goal - velocity_) * approach(seconds, kStartUpTime);
    feet_ += velocity_ * seconds;
}

void Walker::advance_walk(const Steering& steering, float seconds) {
    const Vec3 wish = limited(ahead(steering.yaw) * steering.move.z + to_the_right(steering.yaw) * steering.move.x);
    const Vec3 goal = wish * (steering.run ? kRunSpeed : kWalkSpeed);
    const float share = approach(seconds, on_floor_ ? kStartUpTime : kAirControlTime);
    velocity_.x += (goal.x - velocity_.x) * share;
    velocity_.z += (goal.z - velocity_.z) * share;
    if (steering.jump && on_floor_) {
        velocity_.y = kJumpSpeed;
        on_floor_ = false;
    }
    // A third of the radius at a time: the axis cannot get past a wall before it is pushed back.
    const float distance = (glm::length(velocity_) + kGravity * seconds) * seconds;
    const int steps = std::max(1, int(std::ceil(distance / (shape_.radius / 3))));
    for (int i = 0; i < steps; ++i) substep(seconds / float(steps));
    return_when_lost();
}

void Walker::substep(float seconds) {
    const Vec3 before = feet_;
    const bool was_stuck = stuck();
    if (!on_floor_) velocity_.y = std::max(velocity_.y - kGravity * seconds, -kFallLimit);
    feet_ += velocity_ * seconds;
    push_out();
    if (on_floor_) velocity_.y = 0;  // a leaning wall is no ramp
    meet_floor();
    // Wedged between surfaces that push against each other, or between floor and ceiling: rather stay.
    if (!was_stuck && stuck()) {
        feet_ = before;
        velocity_ = Vec3(0.0f);
        meet_floor();
    }
}

void Walker::push_out() {
    for (int i = 0; i < kPushes; ++i) {
        const std::optional<Contact> contact = level_.deepest_contact(capsule(feet_));
        if (!contact) return;
        feet_ += contact->away * (contact->depth + kSkin);
        velocity_ -= contact->away * std::min(glm::dot(velocity_, contact->away), 0.0f);
    }
}

bool Walker::stuck() const {
    const std::optional<Contact> contact = level_.deepest_contact(capsule(feet_));
    return contact && contact->depth > 0.01f;
}

// The floor under the middle, or under the rim when the middle hangs over a gap.
void Walker::meet_floor() {
    if (velocity_.y > 0) {
        on_floor_ = false;
        return;
    }
    // On the floor a step down is followed; in the air only what the feet have reached.
    const float below = on_floor_ ? feet_.y - shape_.step : feet_.y, above = feet_.y + shape_.step;
    std::optional<float> floor = level_.floor_height(feet_.x, feet_.z, below, above);
    const float rim = 0.5f * shape_.radius;
    for (const Vec2& aside : {Vec2(rim, 0), Vec2(-rim, 0), Vec2(0, rim), Vec2(0, -rim)}) {
        if (floor) break;
        floor = level_.floor_height(feet_.x + aside.x, feet_.z + aside.y, below, above);
    }
    on_floor_ = floor.has_value();
    if (!floor) return;
    // No faster up than a third of the radius a substep, so that the head stops at ceilings like the body at walls.
    const float rise = std::min(*floor - feet_.y, shape_.radius / 3);
    feet_.y += rise;
    eye_lag_ += rise;
    velocity_.y = 0;
}

void Walker::return_when_lost() {
    if (!level_.empty() && feet_.y < level_.bounds().min.y - 20) place(start_);
}

}  // namespace daylit
