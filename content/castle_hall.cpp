// The great hall's timber, furniture, cloth and lamps.
#include <algorithm>
#include <array>
#include <cmath>

#include "content/castle.h"

namespace daylit::content {
namespace {

constexpr std::array<float, 6> kBays = {-13.0f, -7.8f, -2.6f, 2.6f, 7.8f, 13.0f};

void add_timber(Castle& c) {
    MeshBuilder b;
    b.material(c.use.dark_oak);
    for (float x : kBays) {
        b.beam({x, 8.95f, 12.0f - 0.1f}, {x, 8.95f, 23.1f}, 0.42f, 0.52f);
        for (int side : {-1, 1}) {
            const float wall = side < 0 ? 12.0f : 23.0f, in = float(-side);
            // A curved brace from the corbel to the beam, in four straight pieces of a quarter ellipse.
            Vec3 last(0.0f);
            for (int i = 0; i <= 5; ++i) {
                const double a = kPi / 2 * i / 5;
                const Vec3 p(x, 6.5f + 2.3f * float(std::sin(a)),
                             wall + in * (0.2f + 2.6f * (1.0f - float(std::cos(a)))));
                if (i > 0) b.beam(last - 0.04f * glm::normalize(p - last), p, 0.26f, 0.28f, Vec3(1, 0, 0));
                last = p;
            }
            b.beam({x, 6.2f, wall + in * 0.14f}, {x, 8.75f, wall + in * 0.14f}, 0.3f, 0.3f, Vec3(1, 0, 0));
        }
    }
    for (int i = 0; i < 9; ++i) {
        const float z = 12.6f + 1.225f * float(i);
        b.beam({-14.05f, 9.2f, z}, {14.05f, 9.2f, z}, 0.16f, 0.24f);
    }
    c.level.add_object(b.take("hall roof timber"));
}

void add_stonework(Castle& c) {
    MeshBuilder b;
    b.material(c.use.ashlar);
    for (float x : kBays)
        for (float z : {12.02f, 22.98f}) add_column(b, c.use.ashlar, {x, kHallFloor, z}, 0.24f, 5.92f);
    // Mantel: jambs, lintel, a sloping hood and a shelf, around the hearth in the chimney breast.
    b.material(c.use.ashlar);
    for (float x : {-6.2f, -3.8f}) {
        b.bevel_box({x - 0.22f, kHallFloor - 0.01f, 12.66f}, {x + 0.22f, 2.0f, 13.05f}, 0.03f);
        b.bevel_box({x - 0.28f, 1.85f, 12.64f}, {x + 0.28f, 2.05f, 13.2f}, 0.04f);
    }
    b.bevel_box({-6.55f, 2.04f, 12.64f}, {-3.45f, 2.42f, 13.22f}, 0.04f);
    b.bevel_box({-6.65f, 2.41f, 12.62f}, {-3.35f, 2.53f, 13.32f}, 0.04f);
    const std::array<Vec3, 4> foot = {
        Vec3(-6.5f, 2.52f, 12.69f), {-6.5f, 2.52f, 13.15f}, {-3.5f, 2.52f, 13.15f}, {-3.5f, 2.52f, 12.69f}};
    const std::array<Vec3, 4> crown = {
        Vec3(-5.7f, 5.2f, 12.69f), {-5.7f, 5.2f, 12.74f}, {-4.3f, 5.2f, 12.74f}, {-4.3f, 5.2f, 12.69f}};
    b.band(foot, crown, false);
    b.bevel_box({-6.3f, kHallFloor - 0.02f, 12.6f}, {-3.7f, kHallFloor + 0.06f, 13.7f}, 0.02f);
    c.level.add_object(b.take("hall columns and fireplace"));

    b.material(c.use.bark);
    b.tube(std::array{Vec3(-5.5f, 0.52f, 12.1f), Vec3(-4.5f, 0.56f, 12.2f)}, 0.09f, 10);
    b.tube(std::array{Vec3(-5.4f, 0.5f, 11.8f), Vec3(-4.55f, 0.53f, 11.75f)}, 0.1f, 10);
    b.tube(std::array{Vec3(-5.3f, 0.7f, 12.05f), Vec3(-4.7f, 0.67f, 11.8f)}, 0.08f, 10);
    b.material(c.use.iron);
    for (float x : {-5.45f, -4.55f}) {
        b.box({x - 0.02f, 0.42f, 11.6f}, {x + 0.02f, 0.46f, 12.5f});
        b.tube(std::array{Vec3(x, 0.3f, 12.45f), Vec3(x, 0.75f, 12.45f)}, 0.025f, 8);
        b.sphere({x, 0.78f, 12.45f}, 0.05f, 10);
    }
    b.material(c.use.ash);
    b.grid(8, 6, {1, 1}, [](float s, float t) {
        const float heap = std::sin(float(kPi) * s) * std::sin(float(kPi) * t);
        return Vec3(-5.8f + 1.6f * s, 0.305f + 0.1f * heap, 12.6f - 1.1f * t);
    });
    b.material(c.use.embers);
    for (int i = 0; i < 14; ++i) {
        const float a = float(i) * 2.4f, r = 0.42f * std::sqrt(float(i) / 14.0f);
        b.sphere({-5.0f + r * std::cos(a) * 1.2f, 0.42f + 0.02f * float(i % 3), 12.0f + 0.7f * r * std::sin(a)}, 0.045f,
                 6);
    }
    c.level.add_object(b.take("hearth"));
}

void add_table(MeshBuilder& b, const Palette& use, const Vec3& centre, float length, float width) {
    b.material(use.oak);
    const float top = centre.y + 0.78f, x0 = centre.x - 0.5f * length, x1 = centre.x + 0.5f * length;
    const float z0 = centre.z - 0.5f * width, board = width / 4.0f;
    for (int i = 0; i < 4; ++i)
        b.bevel_box({x0, top - 0.06f, z0 + board * float(i) + 0.003f}, {x1, top, z0 + board * float(i + 1) - 0.003f},
                    0.008f, Mapping::Grain);
    for (int i = 0; i <= 3; ++i) {
        const float x = x0 + 0.6f + (length - 1.2f) * float(i) / 3.0f;
        b.bevel_box({x - 0.06f, top - 0.16f, z0 + 0.06f}, {x + 0.06f, top - 0.055f, z0 + width - 0.06f}, 0.01f,
                    Mapping::Grain);
        for (float z : {z0 + 0.2f, z0 + width - 0.2f}) {
            b.at(Vec3(x, centre.y, z));
            const std::array turned = {Vec2(0, 0.0f),      Vec2(0.075f, 0.0f), Vec2(0.075f, 0.1f),  Vec2(0.05f, 0.13f),
                                       Vec2(0.055f, 0.2f), Vec2(0.08f, 0.32f), Vec2(0.055f, 0.44f), Vec2(0.045f, 0.5f),
                                       Vec2(0.07f, 0.54f), Vec2(0.07f, 0.64f), Vec2(0, 0.64f)};
            b.lathe(turned, 12);
            b.at(Mat4(1.0f));
        }
    }
    b.beam({x0 + 0.5f, centre.y + 0.16f, centre.z}, {x1 - 0.5f, centre.y + 0.16f, centre.z}, 0.08f, 0.1f);
}

void add_bench(MeshBuilder& b, const Palette& use, const Vec3& centre, float length) {
    b.material(use.oak);
    const float x0 = centre.x - 0.5f * length, x1 = centre.x + 0.5f * length, y = centre.y;
    b.bevel_box({x0, y + 0.42f, centre.z - 0.18f}, {x1, y + 0.47f, centre.z + 0.18f}, 0.01f, Mapping::Grain);
    for (int i = 0; i <= 3; ++i) {
        const float x = x0 + 0.35f + (length - 0.7f) * float(i) / 3.0f;
        b.bevel_box({x - 0.03f, y, centre.z - 0.15f}, {x + 0.03f, y + 0.425f, centre.z + 0.15f}, 0.006f,
                    Mapping::Grain);
    }
    b.beam({x0 + 0.3f, y + 0.2f, centre.z}, {x1 - 0.3f, y + 0.2f, centre.z}, 0.04f, 0.08f);
}

void add_candelabrum(MeshBuilder& b, const Palette& use, const Vec3& foot, float height) {
    b.at(foot).material(use.brass);
    const float h = height;
    const std::array stem = {Vec2(0, 0),
                             Vec2(0.12f, 0),
                             Vec2(0.12f, 0.015f),
                             Vec2(0.07f, 0.04f),
                             Vec2(0.02f, 0.07f),
                             Vec2(0.016f, 0.4f * h),
                             Vec2(0.03f, 0.45f * h),
                             Vec2(0.016f, 0.5f * h),
                             Vec2(0.014f, 0.86f * h),
                             Vec2(0.03f, h),
                             Vec2(0, h)};
    b.lathe(stem, 14);
    for (int side : {-1, 1}) {
        std::vector<Vec3> arm;
        for (int i = 0; i <= 8; ++i) {
            const double a = kPi * i / 8;
            arm.emplace_back(float(side) * 0.075f * (1.0f - float(std::cos(a))),
                             h * 0.8f - 0.06f * float(std::sin(a)) + 0.02f * float(i) / 8, 0);
        }
        b.tube(arm, 0.009f, 8);
        b.cylinder({float(side) * 0.15f, h * 0.8f + 0.015f, 0}, 0.028f, 0.03f, 12);
    }
    b.at(Mat4(1.0f));
    add_candle(b, use, use.flame, foot + Vec3(0, h, 0), 0.16f);
    for (int side : {-1, 1})
        add_candle(b, use, use.flame, foot + Vec3(0.15f * float(side), h * 0.8f + 0.045f, 0), 0.14f);
}

void add_feast(Castle& c) {
    MeshBuilder b;
    const Palette& use = c.use;
    const float floor = kHallFloor, top = floor + 0.78f;
    const Vec3 table(-0.5f, floor, 16.2f);
    add_table(b, use, table, 10.5f, 1.15f);
    for (float side : {-1.0f, 1.0f}) add_bench(b, use, table + Vec3(0, 0, side * 0.95f), 9.6f);
    c.level.add_object(b.take("long table and benches"));

    for (int i = 0; i < 8; ++i) {
        const float x = -5.0f + 1.3f * float(i);
        for (float side : {-1.0f, 1.0f}) {
            const Vec3 place(x + 0.1f * std::sin(float(i) * 2.3f + side), top, table.z + side * 0.36f);
            b.at(place).material(i % 3 == 1 ? use.earthenware : use.silver);
            b.lathe(std::array{Vec2(0, 0.002f), Vec2(0.08f, 0.002f), Vec2(0.13f, 0.02f), Vec2(0.13f, 0.025f),
                               Vec2(0.08f, 0.01f), Vec2(0, 0.01f)},
                    14);
            b.at(Mat4(1.0f));
            add_goblet(b, i % 2 ? use.silver : use.brass, place + Vec3(0.2f, 0, -side * 0.06f), 0.16f);
            if ((i + int(side)) % 3 == 0) {
                b.at(placed(place + Vec3(0, 0.045f, 0), float(i))).material(use.bread);
                b.at(placed(place + Vec3(0, 0.05f, 0), float(i)) *
                     glm::mat4(Vec4(1.4f, 0, 0, 0), Vec4(0, 0.6f, 0, 0), Vec4(0, 0, 0.9f, 0), Vec4(0, 0, 0, 1)));
                b.sphere({0, 0, 0}, 0.075f, 10);
                b.at(Mat4(1.0f));
            }
        }
    }
    for (float x : {-3.7f, -0.4f, 2.9f}) add_candelabrum(b, use, {x, top, table.z}, 0.42f);
    for (float x : {-2.0f, 1.4f}) {  // bowls of apples
        b.at(Vec3(x, top, table.z)).material(use.earthenware);
        b.lathe(std::array{Vec2(0, 0), Vec2(0.09f, 0), Vec2(0.1f, 0.015f), Vec2(0.19f, 0.09f), Vec2(0.2f, 0.11f),
                           Vec2(0.185f, 0.105f), Vec2(0.1f, 0.03f), Vec2(0, 0.025f)},
                24);
        b.at(Mat4(1.0f)).material(use.apple);
        for (int i = 0; i < 6; ++i) {
            const float a = 1.05f * float(i);
            b.sphere({x + 0.1f * std::cos(a), top + 0.1f, table.z + 0.1f * std::sin(a)}, 0.042f, 8);
        }
        b.sphere({x, top + 0.15f, table.z}, 0.042f, 8);
    }
    for (float x : {-4.6f, 4.0f}) {  // wine jugs
        b.at(Vec3(x, top, table.z + 0.05f)).material(use.silver);
        b.lathe(
            std::array{Vec2(0, 0), Vec2(0.075f, 0), Vec2(0.07f, 0.02f), Vec2(0.1f, 0.1f), Vec2(0.09f, 0.18f),
                       Vec2(0.05f, 0.26f), Vec2(0.06f, 0.32f), Vec2(0.05f, 0.32f), Vec2(0.04f, 0.26f), Vec2(0, 0.24f)},
            20);
        b.tube(std::array{Vec3(0.055f, 0.29f, 0), Vec3(0.12f, 0.29f, 0), Vec3(0.14f, 0.22f, 0), Vec3(0.13f, 0.15f, 0),
                          Vec3(0.095f, 0.12f, 0)},
               0.009f, 8);
        b.at(Mat4(1.0f));
    }
    c.level.add_object(b.take("feast"));
}

void add_cloth(Castle& c) {
    MeshBuilder b;
    const Palette& use = c.use;
    add_hanging(b, c, use.tapestry, {-10.4f, 5.9f, 12.08f}, Facing::South, {2.7f, 4.05f}, 0.02f);
    add_hanging(b, c, use.tapestry, {0.0f, 5.9f, 12.08f}, Facing::South, {2.7f, 4.05f}, 0.02f);
    add_hanging(b, c, use.tapestry, {10.4f, 5.9f, 12.08f}, Facing::South, {2.7f, 4.05f}, 0.02f);
    add_hanging(b, c, use.tapestry, {13.92f, 7.2f, 17.5f}, Facing::West, {3.4f, 5.1f}, 0.02f);
    for (float x : {-7.8f, -2.6f, 2.6f, 7.8f})
        for (float z : {14.4f, 20.6f}) add_hanging(b, c, use.banner, {x, 8.62f, z}, Facing::West, {1.0f, 2.3f}, 0.035f);
    // Gauze on either side of the throne.
    b.material(use.gauze);
    for (float z : {15.7f, 19.3f})
        b.grid(16, 8, {1.2f, 3.6f}, [=](float s, float t) {
            return Vec3(13.5f - 0.05f * std::sin(s * 20.0f) - 0.2f * t * (1 - s), kHallFloor + 0.5f + 3.7f * t,
                        z + (s - 0.5f) * 1.1f);
        });
    add_shield(b, use, use.red_wool, {-13.0f + 2.55f * 2 + 0.05f, 4.3f, 12.0f}, Facing::South);
    add_shield(b, use, use.blue_wool, {3.4f, 4.6f, 12.0f}, Facing::South);
    add_shield(b, use, use.red_wool, {9.0f - 0.5f, 4.6f, 12.0f}, Facing::South);
    add_shield(b, use, use.blue_wool, {-5.0f, 3.6f, 13.0f}, Facing::South);
    for (float z : {13.6f, 21.4f}) add_shield(b, use, use.blue_wool, {14.0f, 4.6f, z}, Facing::West);
    c.level.add_object(b.take("tapestries, banners and shields"));
    // A runner of red wool from the west end to the dais.
    b.material(use.red_wool);
    b.box({-12.5f, kHallFloor - 0.01f, 17.75f}, {10.19f, kHallFloor + 0.015f, 18.95f});
    b.material(use.gold);
    for (float z : {17.75f, 18.87f})
        b.box({-12.48f, kHallFloor - 0.005f, z + 0.02f}, {10.18f, kHallFloor + 0.018f, z + 0.06f});
    c.level.add_object(b.take("runner"));
}

void add_throne(MeshBuilder& b, const Palette& use, const Vec3& foot) {
    b.at(foot).material(use.dark_oak);
    b.bevel_box({-0.05f, 0.0f, -0.42f}, {0.65f, 0.12f, 0.42f}, 0.02f, Mapping::Grain);
    b.bevel_box({0.0f, 0.115f, -0.38f}, {0.62f, 0.46f, 0.38f}, 0.015f, Mapping::Grain);
    b.bevel_box({0.52f, 0.0f, -0.4f}, {0.66f, 1.75f, 0.4f}, 0.02f, Mapping::Grain);
    for (float z : {-0.4f, 0.4f}) {
        b.bevel_box({-0.02f, 0.11f, z - 0.06f}, {0.56f, 0.74f, z + 0.06f}, 0.015f, Mapping::Grain);
        b.bevel_box({0.5f, 0.1f, z - 0.05f}, {0.68f, 1.95f, z + 0.05f}, 0.02f, Mapping::Grain);
        b.material(use.gold).sphere({0.59f, 2.0f, z}, 0.07f, 14);
        b.material(use.dark_oak);
    }
    b.material(use.red_wool);
    b.bevel_box({0.02f, 0.45f, -0.33f}, {0.53f, 0.54f, 0.33f}, 0.03f);
    b.bevel_box({0.47f, 0.7f, -0.3f}, {0.53f, 1.6f, 0.3f}, 0.025f);
    std::vector<Vec3> front, back;  // gabled crest
    for (const Vec2& p :
         {Vec2(-0.4f, 1.74f), Vec2(0.4f, 1.74f), Vec2(0.25f, 2.0f), Vec2(0, 2.2f), Vec2(-0.25f, 2.0f)}) {
        front.emplace_back(0.54f, p.y, p.x);
        back.emplace_back(0.64f, p.y, p.x);
    }
    b.material(use.gold);
    b.flat_polygon(std::vector<Vec3>(front.begin(), front.end()));
    b.flat_polygon(std::vector<Vec3>(back.rbegin(), back.rend()));
    b.band(back, front, true);
    b.at(Mat4(1.0f));
}

void add_dais(Castle& c) {
    MeshBuilder b;
    const float y = kHallFloor + 0.32f;
    add_throne(b, c.use, {12.6f, y, 17.0f});
    add_throne(b, c.use, {12.6f, y, 18.0f});
    c.level.add_object(b.take("thrones"));
    for (float z : {14.2f, 20.8f}) {
        // Standing candelabra: a tripod and a crown of five candles.
        const Vec3 foot(12.0f, y, z);
        b.material(c.use.iron);
        for (int i = 0; i < 3; ++i) {
            const float a = 2.0944f * float(i);
            b.tube(std::array{foot + Vec3(0.32f * std::cos(a), 0.015f, 0.32f * std::sin(a)),
                              foot + Vec3(0.16f * std::cos(a), 0.14f, 0.16f * std::sin(a)), foot + Vec3(0, 0.3f, 0)},
                   0.018f, 8);
        }
        b.tube(std::array{foot + Vec3(0, 0.28f, 0), foot + Vec3(0, 1.75f, 0)}, 0.022f, 10);
        b.torus(foot + Vec3(0, 1.7f, 0), 0.28f, 0.015f, 24, 6);
        for (int i = 0; i < 5; ++i) {
            const float a = 1.2566f * float(i);
            const Vec3 p = foot + Vec3(0.28f * std::cos(a), 1.7f, 0.28f * std::sin(a));
            b.material(c.use.iron);
            b.tube(std::array{foot + Vec3(0, 1.66f, 0), p}, 0.012f, 6);
            b.cylinder(p + Vec3(0, 0.01f, 0), 0.04f, 0.02f, 10);
            add_candle(b, c.use, c.use.flame, p + Vec3(0, 0.03f, 0), 0.18f);
        }
        c.level.add_lamp(
            {z < 17 ? "candelabrum north" : "candelabrum south", Rgb(1.0f, 0.56f, 0.22f) * 160.0f, Lit::Evening},
            foot + Vec3(0, 2.12f, 0));
    }
    c.level.add_object(b.take("candelabra"));
}

void add_chandeliers(Castle& c) {
    MeshBuilder b;
    int number = 1;
    for (float x : {-7.8f, -0.2f, 7.4f}) {
        const Vec3 centre(x, 4.9f, 17.4f);
        b.material(c.use.iron);
        b.torus(centre, 1.0f, 0.03f, 36, 8);
        b.torus(centre + Vec3(0, 0.5f, 0), 0.5f, 0.022f, 28, 6);
        for (int i = 0; i < 10; ++i) {
            const float a = 0.62832f * float(i);
            const Vec3 out(std::cos(a), 0, std::sin(a)), p = centre + out;
            b.material(c.use.iron);
            if (i % 2 == 0) {
                b.tube(std::array{p, centre + 0.5f * out + Vec3(0, 0.5f, 0), centre + Vec3(0, 1.3f, 0)}, 0.012f, 6);
                b.tube(std::array{p, centre + 0.06f * out}, 0.014f, 6);
            }
            b.cylinder(p + Vec3(0, 0.02f, 0), 0.06f, 0.02f, 12);
            add_candle(b, c.use, c.use.flame, p + Vec3(0, 0.04f, 0), 0.16f);
        }
        b.material(c.use.iron);
        b.sphere(centre, 0.09f, 12);
        b.tube(std::array{centre + Vec3(0, 1.28f, 0), Vec3(x, kHallCeiling + 0.02f, centre.z)}, 0.018f, 6);
        b.sphere(centre + Vec3(0, 1.3f, 0), 0.06f, 10);
        // One light for the ten candles, inside the cone of rods: so high that the ring's shadow falls on the floor and
        // not as a bar along the walls.
        c.level.add_lamp({"chandelier " + std::to_string(number++), Rgb(1.0f, 0.56f, 0.22f) * 620.0f, Lit::Evening},
                         centre + Vec3(0, 1.05f, 0));
    }
    c.level.add_object(b.take("chandeliers"));
}

// Oak panelling 1.1 m high: stiles and rails around sunk fields, under a moulded top.
void add_panelling(MeshBuilder& b, const Palette& use, const Vec3& start, Facing facing, float length) {
    Opening frame{.origin = start, .facing = facing, .loops = {}};
    b.at(wall_frame(frame)).material(use.dark_oak);
    const float h = 1.1f;
    const int fields = std::max(1, int(length / 0.62f + 0.5f));
    b.box({0, -0.01f, -0.02f}, {length, h, 0.02f}, Mapping::Grain);
    b.bevel_box({0, -0.01f, -0.01f}, {length, 0.18f, 0.055f}, 0.012f, Mapping::Grain);
    b.bevel_box({0, h - 0.14f, -0.01f}, {length, h, 0.05f}, 0.008f, Mapping::Grain);
    b.bevel_box({-0.01f, h - 0.02f, -0.02f}, {length + 0.01f, h + 0.04f, 0.09f}, 0.018f, Mapping::Grain);
    for (int i = 0; i <= fields; ++i) {
        const float x = (length - 0.1f) * float(i) / float(fields);
        b.bevel_box({x, 0.17f, -0.01f}, {x + 0.1f, h - 0.13f, 0.045f}, 0.008f, Mapping::Grain);
    }
    b.at(Mat4(1.0f));
}

void add_panels(Castle& c) {
    MeshBuilder b;
    const auto wall = [&](const Vec3& start, Facing facing, float length) {
        add_panelling(b, c.use, start + Vec3(0, kHallFloor, 0), facing, length);
    };
    // North wall (facing south, x to the right) between columns, hearth and door; south wall; west wall.
    wall({-12.66f, 0, 12}, Facing::South, 4.52f);
    wall({-7.46f, 0, 12}, Facing::South, 0.86f);
    wall({-3.4f, 0, 12}, Facing::South, 0.46f);
    wall({-2.26f, 0, 12}, Facing::South, 4.52f);
    wall({2.94f, 0, 12}, Facing::South, 2.06f);
    wall({8.14f, 0, 12}, Facing::South, 2.06f);
    for (float x : {-7.8f, -2.6f, 2.6f, 7.8f}) wall({x - 0.34f, 0, 23}, Facing::North, 4.52f);
    wall({10.2f, 0, 23}, Facing::North, 2.06f);
    wall({-14, 0, 22.6f}, Facing::East, 10.2f);
    c.level.add_object(b.take("hall panelling"));
}

}  // namespace

void furnish_hall(Castle& c) {
    add_panels(c);
    add_timber(c);
    add_stonework(c);
    add_feast(c);
    add_cloth(c);
    add_dais(c);
    add_chandeliers(c);
}

}  // namespace daylit::content
