#pragma once
// A person who walks, runs, climbs stairs, jumps and falls, or flies; moved by the time that passes.
#include "demo/walk/collider.h"

namespace daylit {

/// What the keys ask for in one frame.
struct Steering {
    Vec3 move = Vec3(0.0f);  // x right, y up (flying only), z ahead; each -1, 0 or 1
    float yaw = 0.0f;        // radians, counter-clockwise seen from above; 0 looks along -Z
    float pitch = 0.0f;      // radians, upwards; steers flight
    bool run = false;
    bool jump = false;
};

struct WalkerShape {
    float radius = 0.28f;   // metres
    float stature = 1.75f;  // crown over feet
    float eye = 1.62f;      // over feet
    float step = 0.4f;      // what feet climb without a jump
};

class Walker {
  public:
    /// Stands with its eye here; on the floor below when there is one within a storey, else it flies.
    Walker(const Collider& level, const Vec3& eye);

    void place(const Vec3& eye);
    /// Moves on by `seconds` (more than a quarter of a second is taken as that, so that a hitch is no leap).
    void advance(const Steering& steering, float seconds);

    void fly(bool on);
    bool flying() const { return flying_; }
    bool on_floor() const { return on_floor_; }
    Vec3 feet() const { return feet_; }
    Vec3 velocity() const { return velocity_; }
    /// Where the camera is; stairs are smoothed away.
    Vec3 eye() const;
    const WalkerShape& shape() const { return shape_; }

  private:
    Capsule capsule(const Vec3& feet) const;
    void advance_flight(const Steering& steering, float seconds);
    void advance_walk(const Steering& steering, float seconds);
    void substep(float seconds);
    void push_out();
    bool stuck() const;
    void meet_floor();
    void return_when_lost();

    const Collider& level_;
    WalkerShape shape_;
    Vec3 feet_ = Vec3(0.0f);
    Vec3 velocity_ = Vec3(0.0f);
    Vec3 start_ = Vec3(0.0f);  // eye of the last place()
    float eye_lag_ = 0.0f;     // metres that the camera still has to climb (or sink) after a step
    bool on_floor_ = false;
    bool flying_ = false;
};

}  // namespace daylit
