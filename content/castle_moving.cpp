// What moves: a door that swings, a teapot on a cart that rolls, a figure that walks.
#include <array>
#include <cmath>

#include "content/castle.h"
#include "content/figures.h"

namespace daylit::content {
namespace {

Vec4 turn(const Vec3& axis, double angle) {
    const Quat q = glm::angleAxis(float(angle), axis);
    return {q.x, q.y, q.z, q.w};
}

// One leaf in the hall's door, hinged on its east side; it opens into the hall.
void add_door(Castle& c) {
    MeshBuilder b;
    const float width = 1.86f, spring = 2.49f, thick = 0.09f;
    std::vector<Vec3> front, back;
    for (const Vec2& p : outline(Head::Segmental, width, 0.015f, spring)) {
        front.emplace_back(p.x - 0.5f * width, p.y, 0.5f * thick);
        back.emplace_back(p.x - 0.5f * width, p.y, -0.5f * thick);
    }
    // Boards: vertical grain, so the texture is laid by hand along y.
    b.material(c.use.oak);
    const auto board_face = [&](const std::vector<Vec3>& points, const Vec3& n) {
        std::vector<std::uint32_t> v;
        for (const Vec3& p : points) v.push_back(b.vertex(p, n, {p.y, p.x}));
        for (std::size_t i = 1; i + 1 < v.size(); ++i) b.triangle(v[0], v[i], v[i + 1]);
    };
    board_face(front, {0, 0, 1});
    board_face({back.rbegin(), back.rend()}, {0, 0, -1});
    b.band(back, front, true);
    b.material(c.use.dark_oak);
    for (int i = 1; i < 7; ++i) {  // cover strips
        const float x = -width + width * float(i) / 7.0f;
        for (float z : {-0.5f * thick, 0.5f * thick})
            b.bevel_box({x - 0.02f, 0.03f, z - 0.012f}, {x + 0.02f, 2.5f, z + 0.012f}, 0.005f, Mapping::Grain);
    }
    b.material(c.use.iron);
    for (float y : {0.45f, 1.3f, 2.2f}) {
        for (float z : {-0.5f * thick, 0.5f * thick})
            b.bevel_box({-1.6f, y - 0.04f, z - 0.018f}, {-0.02f, y + 0.04f, z + 0.018f}, 0.006f);
        b.cylinder({-0.01f, y - 0.1f, 0}, 0.03f, 0.2f, 10);
    }
    for (float z : {-0.5f * thick - 0.03f, 0.5f * thick + 0.03f}) {
        b.sphere({-1.72f, 1.1f, z}, 0.035f, 12);
        std::vector<Vec3> ring;
        for (int i = 0; i <= 16; ++i) {
            const double a = 2.0 * kPi * i / 16;
            ring.emplace_back(-1.72f + 0.07f * float(std::sin(a)), 1.03f + 0.07f * float(std::cos(a)), z);
        }
        b.tube(ring, 0.01f, 6);
    }
    LevelNode door;
    door.name = "swinging door";
    // Seen from the hall (facing north) the hinge is on the right, at the larger x.
    door.translation = {6.2f + 0.93f, kHallFloor, 11.9f};
    door.rotation = glm::angleAxis(float(56.0 * kDegree), Vec3(0, 1, 0));
    door.mesh = c.level.add_mesh(b.take("door leaf"));
    const int node = c.level.add_node(door);
    LevelChannel swing{node, AnimationPath::Rotation, {}, {}};
    // Between 8 and 104 degrees, as in a slow draught; half open at the start.
    for (int i = 0; i <= 32; ++i) {
        swing.times.push_back(0.5f * float(i));
        swing.values.push_back(turn({0, 1, 0}, (56.0 + 48.0 * std::sin(2.0 * kPi * (i % 32) / 32)) * kDegree));
    }
    c.level.animations.push_back({"door swings", {swing}});
}

void add_wheel(MeshBuilder& b, const Palette& use, float radius) {
    // Axle along z through the origin.
    Mat4 lying(1.0f);
    lying[1] = Vec4(0, 0, 1, 0);
    lying[2] = Vec4(0, -1, 0, 0);
    b.at(lying).material(use.dark_oak);
    b.lathe(std::array{Vec2(radius - 0.05f, -0.025f), Vec2(radius - 0.008f, -0.025f), Vec2(radius - 0.008f, 0.025f),
                       Vec2(radius - 0.05f, 0.025f), Vec2(radius - 0.05f, -0.025f)},
            28);
    b.lathe(std::array{Vec2(0, -0.06f), Vec2(0.045f, -0.06f), Vec2(0.055f, 0.0f), Vec2(0.045f, 0.06f), Vec2(0, 0.06f)},
            14);
    b.material(use.iron);
    b.lathe(std::array{Vec2(radius - 0.009f, -0.027f), Vec2(radius, -0.027f), Vec2(radius, 0.027f),
                       Vec2(radius - 0.009f, 0.027f)},
            28);
    b.at(Mat4(1.0f)).material(use.dark_oak);
    for (int i = 0; i < 8; ++i) {
        const float a = 0.7854f * float(i);
        const Vec3 out(std::cos(a), std::sin(a), 0);
        b.beam(out * 0.04f, out * (radius - 0.03f), 0.025f, 0.03f, Vec3(0, 0, 1));
    }
}

void add_cart(Castle& c) {
    const Palette& use = c.use;
    const float radius = 0.24f, from = -6.0f, to = 7.5f;
    MeshBuilder b;
    b.material(use.oak);
    for (int i = 0; i < 5; ++i)
        b.bevel_box({-0.5f, 0.62f, -0.325f + 0.13f * float(i) + 0.002f},
                    {0.5f, 0.66f, -0.195f + 0.13f * float(i) - 0.002f}, 0.006f, Mapping::Grain);
    b.material(use.dark_oak);
    for (float z : {-0.3f, 0.3f}) {
        b.bevel_box({-0.52f, 0.54f, z - 0.03f}, {0.52f, 0.625f, z + 0.03f}, 0.008f, Mapping::Grain);
        for (float x : {-0.33f, 0.33f})
            b.bevel_box({x - 0.035f, 0.2f, z - 0.025f}, {x + 0.035f, 0.545f, z + 0.025f}, 0.008f, Mapping::Grain);
        b.bevel_box({-0.46f, 0.655f, z + (z < 0 ? -0.02f : 0.0f)}, {0.46f, 0.7f, z + (z < 0 ? 0.0f : 0.02f)}, 0.006f,
                    Mapping::Grain);
        b.beam({-0.5f, 0.6f, z}, {-0.82f, 0.86f, z}, 0.04f, 0.05f);
    }
    b.beam({-0.81f, 0.85f, -0.34f}, {-0.81f, 0.85f, 0.34f}, 0.045f, 0.045f);
    b.material(use.iron);
    for (float x : {-0.33f, 0.33f}) b.tube(std::array{Vec3(x, radius, -0.42f), Vec3(x, radius, 0.42f)}, 0.018f, 10);
    // The service: teapot, two cups on a tray.
    b.material(use.silver);
    b.at(Vec3(0.02f, 0.66f, 0));
    b.lathe(std::array{Vec2(0, 0.0f), Vec2(0.25f, 0.0f), Vec2(0.27f, 0.02f), Vec2(0.262f, 0.02f), Vec2(0.245f, 0.008f),
                       Vec2(0, 0.008f)},
            32);
    b.at(Mat4(1.0f));
    const Mat4 pot = placed({-0.02f, 0.669f, 0.02f}, -0.6f, 0.085f);
    add_teapot(b, use.brass, pot, 6);
    for (float x : {0.16f, -0.02f}) {
        b.at(Vec3(x, 0.668f, x > 0 ? 0.14f : -0.19f)).material(use.earthenware);
        b.lathe(std::array{Vec2(0, 0), Vec2(0.02f, 0), Vec2(0.035f, 0.03f), Vec2(0.038f, 0.055f), Vec2(0.034f, 0.055f),
                           Vec2(0.03f, 0.03f), Vec2(0, 0.01f)},
                16);
    }
    LevelNode cart;
    cart.name = "rolling cart";
    cart.translation = {from, kHallFloor, 20.9f};
    cart.mesh = c.level.add_mesh(b.take("cart with teapot"));
    const int node = c.level.add_node(cart);

    // There and back with a pause at each end; the wheels turn by the way over the radius.
    const float run = 14.0f, pause = 1.5f;
    std::vector<float> times;
    std::vector<float> places;
    const int steps = 64;  // a wheel turns less than half a turn from key to key
    const auto eased = [&](float t) { return 0.5f - 0.5f * std::cos(float(kPi) * t); };
    for (int i = 0; i <= steps; ++i) {
        times.push_back(run * float(i) / steps);
        places.push_back(from + (to - from) * eased(float(i) / steps));
    }
    for (int i = 0; i <= steps; ++i) {
        times.push_back(run + pause + run * float(i) / steps);
        places.push_back(to + (from - to) * eased(float(i) / steps));
    }
    times.push_back(2.0f * (run + pause));
    places.push_back(from);
    LevelAnimation roll{"cart rolls", {}};
    LevelChannel way{node, AnimationPath::Translation, times, {}};
    for (float x : places) way.values.emplace_back(x, kHallFloor, 20.9f, 0);
    roll.channels.push_back(way);
    add_wheel(b, use, radius);
    const int wheel_mesh = c.level.add_mesh(b.take("wheel"));
    for (float x : {-0.33f, 0.33f})
        for (float z : {-0.39f, 0.39f}) {
            LevelNode wheel;
            wheel.name = std::string("wheel ") + (x < 0 ? "rear " : "front ") + (z < 0 ? "right" : "left");
            wheel.translation = {x, radius, z};
            wheel.mesh = wheel_mesh;
            LevelChannel spin{c.level.add_node(wheel, node), AnimationPath::Rotation, times, {}};
            for (float p : places) spin.values.push_back(turn({0, 0, 1}, -double(p - from) / double(radius)));
            roll.channels.push_back(spin);
        }
    c.level.animations.push_back(roll);
}

}  // namespace

void add_moving_things(Castle& c) {
    add_door(c);
    add_cart(c);
    add_walker(c);
}

}  // namespace daylit::content
