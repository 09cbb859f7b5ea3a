// What stands in the treasury, the cellar and the courtyard.
#include <algorithm>
#include <array>
#include <cmath>

#include "content/castle.h"
#include "content/figures.h"
#include "engine/base/random.h"

namespace daylit::content {
namespace {

void add_bookshelf(MeshBuilder& b, const Palette& use, const Mat4& place) {
    const float w = 2.2f, h = 2.6f, d = 0.42f;
    b.at(place).material(use.dark_oak);
    for (float x : {0.0f, 0.5f * w, w}) b.bevel_box({x - 0.03f, 0, 0}, {x + 0.03f, h, d}, 0.006f, Mapping::Grain);
    b.bevel_box({-0.03f, 0, 0.0f}, {w + 0.03f, h, 0.02f}, 0.0f, Mapping::Grain);
    b.bevel_box({-0.1f, h - 0.01f, -0.005f}, {w + 0.1f, h + 0.1f, d + 0.08f}, 0.03f, Mapping::Grain);
    b.bevel_box({-0.06f, -0.01f, -0.005f}, {w + 0.06f, 0.12f, d + 0.04f}, 0.02f, Mapping::Grain);
    for (int i = 0; i < 6; ++i) {
        const float y = 0.12f + 0.4f * float(i);
        b.material(use.dark_oak).box({0.02f, y, 0.015f}, {w - 0.02f, y + 0.03f, d - 0.01f}, Mapping::Grain);
        if (i == 5) continue;
        for (int side = 0; side < 2; ++side) {
            const float x0 = side * 0.5f * w + 0.04f, room = 0.5f * w - 0.08f;
            Random random(7, std::uint64_t(i), std::uint64_t(side));
            const float filled = room * (0.6f + 0.38f * random.next()), tall = 0.25f + 0.06f * random.next();
            b.material(use.books);
            const float shift = random.next();
            const Vec3 low(x0, y + 0.03f, 0.1f), high(x0 + filled, y + 0.03f + tall, d - 0.06f);
            b.box(low, high);
            Geometry& g = b.part();  // the last box's 24 vertices: backs show whole volumes
            for (std::size_t k = g.uvs.size() - 24; k < g.uvs.size(); ++k) g.uvs[k] += Vec2(shift, 0.32f);
        }
    }
    b.at(Mat4(1.0f));
}

void add_plinth(MeshBuilder& b, int material, const Vec3& foot, float width, float height) {
    b.material(material);
    const float w = 0.5f * width;
    b.bevel_box(foot + Vec3(-w - 0.1f, -0.01f, -w - 0.1f), foot + Vec3(w + 0.1f, 0.12f, w + 0.1f), 0.02f);
    b.bevel_box(foot + Vec3(-w - 0.04f, 0.115f, -w - 0.04f), foot + Vec3(w + 0.04f, 0.18f, w + 0.04f), 0.025f);
    b.bevel_box(foot + Vec3(-w, 0.175f, -w), foot + Vec3(w, height - 0.1f, w), 0.015f);
    b.bevel_box(foot + Vec3(-w - 0.06f, height - 0.105f, -w - 0.06f), foot + Vec3(w + 0.06f, height, w + 0.06f), 0.03f);
}

void add_tree(MeshBuilder& b, const Palette& use, std::uint64_t seed, float height, int sprays) {
    Random random(11, seed, 0);
    b.material(use.bark);
    const Vec3 fork(0.1f, 0.42f * height, 0.05f);
    b.tube(std::array{Vec3(0, -0.1f, 0), Vec3(0.02f, 0.1f, 0), Vec3(0.06f, 0.2f * height, 0.02f), fork},
           std::array{0.3f, 0.2f, 0.15f, 0.12f}, 10);
    std::vector<Vec3> tips;
    for (int i = 0; i < 7; ++i) {
        const float a = 0.9f * float(i) + 0.6f * random.next(), reach = height * (0.2f + 0.12f * random.next());
        const Vec3 tip = fork + Vec3(std::cos(a) * reach, height * (0.16f + 0.3f * random.next()), std::sin(a) * reach);
        const Vec3 bend = glm::mix(fork, tip, 0.5f) + Vec3(0, 0.08f * height, 0);
        b.tube(std::array{fork - Vec3(0, 0.05f, 0), bend, tip}, std::array{0.09f, 0.05f, 0.015f}, 7);
        tips.push_back(tip);
        tips.push_back(bend);
    }
    b.material(use.leaves);
    const Vec3 middle(0.1f, 0.68f * height, 0.05f);
    for (int i = 0; i < sprays; ++i) {
        // Sprays fill a rounded crown, thicker towards its skin, facing mostly outwards and up.
        const double z = 2.0 * random.next_double() - 1.0, turn = 2.0 * kPi * random.next_double(),
                     s = std::sqrt(1.0 - z * z);
        const Vec3 out(float(s * std::cos(turn)), float(z), float(s * std::sin(turn)));
        const float depth = 0.55f + 0.45f * std::sqrt(random.next());
        const float lump = 1.0f + 0.16f * std::sin(5.0f * out.x + float(seed)) * std::sin(4.0f * out.z + 2.0f * out.y);
        const Vec3 p = middle + out * Vec3(0.36f, 0.33f, 0.36f) * height * depth * lump;
        const Vec3 n =
            glm::normalize(out + 0.8f * Vec3(random.next() - 0.5f, random.next() - 0.2f, random.next() - 0.5f));
        const Vec3 u = glm::normalize(glm::cross(n, Vec3(random.next() - 0.5f, 1.0f, random.next() - 0.5f)));
        const Vec3 v = glm::cross(n, u);
        const float size = 0.36f + 0.2f * random.next();
        b.picture_quad(p - size * u - size * v, p + size * u - size * v, p + size * u + size * v,
                       p - size * u + size * v, {1, 1});
    }
}

void add_bush(MeshBuilder& b, const Palette& use, const Vec3& foot, float radius, std::uint64_t seed) {
    Random random(13, seed, 0);
    b.material(use.leaves);
    for (int i = 0; i < 70; ++i) {
        const double z = random.next_double(), turn = 2.0 * kPi * random.next_double(), s = std::sqrt(1.0 - z * z);
        const Vec3 out(float(s * std::cos(turn)), float(z), float(s * std::sin(turn)));
        const Vec3 p = foot + out * radius * (0.6f + 0.4f * random.next());
        const Vec3 n = glm::normalize(out + 0.6f * Vec3(random.next() - 0.5f, random.next(), random.next() - 0.5f));
        const Vec3 u = glm::normalize(glm::cross(n, Vec3(0.1f, 1, 0.2f))), v = glm::cross(n, u);
        const float size = 0.2f + 0.1f * random.next();
        b.picture_quad(p - size * u - size * v, p + size * u - size * v, p + size * u + size * v,
                       p - size * u + size * v, {1, 1});
    }
}

void add_lamp_post(Castle& c, MeshBuilder& b, const Vec3& foot, const std::string& name) {
    const Palette& use = c.use;
    b.at(foot).material(use.iron);
    b.bevel_box({-0.16f, -0.02f, -0.16f}, {0.16f, 0.14f, 0.16f}, 0.02f);
    b.lathe(std::array{Vec2(0.12f, 0.13f), Vec2(0.12f, 0.2f), Vec2(0.06f, 0.32f), Vec2(0.05f, 0.5f),
                       Vec2(0.065f, 0.53f), Vec2(0.045f, 0.57f), Vec2(0.035f, 2.6f), Vec2(0.06f, 2.64f),
                       Vec2(0.035f, 2.7f), Vec2(0.03f, 2.86f), Vec2(0.0f, 2.86f)},
            14);
    // Lantern: an open cage of four bars under a small roof; the flame below, the light at the cage's middle.
    const float low = 2.86f, high = 3.3f;
    b.lathe(std::array{Vec2(0, low - 0.01f), Vec2(0.1f, low - 0.01f), Vec2(0.1f, low + 0.015f), Vec2(0, low + 0.015f)},
            8);
    for (int i = 0; i < 4; ++i) {
        const float a = 1.5708f * float(i) + 0.7854f;
        b.tube(std::array{Vec3(0.1f * std::cos(a), low, 0.1f * std::sin(a)),
                          Vec3(0.16f * std::cos(a), high, 0.16f * std::sin(a))},
               0.009f, 6);
    }
    b.lathe(std::array{Vec2(0, high - 0.01f), Vec2(0.2f, high - 0.02f), Vec2(0.2f, high), Vec2(0.09f, high + 0.13f),
                       Vec2(0.04f, high + 0.16f), Vec2(0.04f, high + 0.2f), Vec2(0.0f, high + 0.26f)},
            8);
    b.material(use.bulb);
    b.lathe(std::array{Vec2(0, low + 0.016f), Vec2(0.03f, low + 0.03f), Vec2(0.035f, low + 0.06f),
                       Vec2(0.02f, low + 0.11f), Vec2(0, low + 0.15f)},
            10);
    b.at(Mat4(1.0f));
    c.level.add_lamp({name, Rgb(1.0f, 0.6f, 0.26f) * 260.0f, Lit::Evening}, foot + Vec3(0, low + 0.27f, 0));
}

void add_well(MeshBuilder& b, const Palette& use, const Vec3& at) {
    b.at(at).material(use.ashlar);
    b.lathe(
        std::array{Vec2(1.05f, -0.05f), Vec2(1.05f, 0.1f), Vec2(0.95f, 0.14f), Vec2(0.95f, 0.72f), Vec2(1.03f, 0.76f),
                   Vec2(1.03f, 0.86f), Vec2(0.98f, 0.9f), Vec2(0.7f, 0.9f), Vec2(0.66f, 0.86f), Vec2(0.66f, 0.02f)},
        32);
    b.material(use.water).cylinder({0, 0.0f, 0}, 0.67f, 0.25f, 32);
    b.material(use.dark_oak);
    for (float x : {-0.85f, 0.85f}) {
        b.bevel_box({x - 0.07f, 0.88f, -0.07f}, {x + 0.07f, 2.35f, 0.07f}, 0.01f, Mapping::Grain);
        for (float z : {-1.0f, 1.0f}) b.beam({x, 2.0f, 0}, {x, 2.42f, z * 0.5f}, 0.07f, 0.07f);
    }
    b.beam({-1.0f, 2.36f, 0}, {1.0f, 2.36f, 0}, 0.12f, 0.12f);
    b.beam({-1.0f, 1.45f, 0}, {1.0f, 1.45f, 0}, 0.16f, 0.16f);
    b.material(use.iron);
    b.tube(std::array{Vec3(0.98f, 1.45f, 0), Vec3(1.12f, 1.45f, 0), Vec3(1.12f, 1.2f, 0), Vec3(1.26f, 1.2f, 0)}, 0.018f,
           6);
    b.material(use.leather).tube(std::array{Vec3(0.1f, 1.4f, 0.08f), Vec3(0.1f, 0.98f, 0.08f)}, 0.012f, 6);
    b.at(at + Vec3(0.1f, 0.6f, 0.08f)).material(use.oak);
    b.lathe(std::array{Vec2(0, 0), Vec2(0.13f, 0), Vec2(0.17f, 0.3f), Vec2(0.15f, 0.3f), Vec2(0.12f, 0.03f),
                       Vec2(0, 0.03f)},
            16);
    b.at(at);
    b.material(use.iron).tube(
        std::array{Vec3(-0.06f, 0.88f, 0.08f), Vec3(0.1f, 1.02f, 0.08f), Vec3(0.26f, 0.88f, 0.08f)}, 0.01f, 6);
    // A tiled roof, closed underneath.
    const float y = 2.4f, ridge = 3.1f, x = 1.25f, z = 0.95f;
    b.material(use.roof);
    b.picture_quad({-x, y, z}, {x, y, z}, {x, ridge, 0}, {-x, ridge, 0}, {2 * x, 1.2f});
    b.picture_quad({x, y, -z}, {-x, y, -z}, {-x, ridge, 0}, {x, ridge, 0}, {2 * x, 1.2f});
    b.material(use.oak);
    b.flat_triangle({x, y, z}, {x, y, -z}, {x, ridge, 0});
    b.flat_triangle({-x, y, -z}, {-x, y, z}, {-x, ridge, 0});
    b.flat_quad({-x, y, -z}, {x, y, -z}, {x, y, z}, {-x, y, z});
    b.at(Mat4(1.0f));
}

void add_planter(MeshBuilder& b, const Palette& use, const Vec3& at, float radius) {
    b.at(at).material(use.ashlar);
    b.lathe(std::array{Vec2(radius + 0.25f, -0.02f), Vec2(radius + 0.25f, 0.3f), Vec2(radius + 0.3f, 0.33f),
                       Vec2(radius + 0.3f, 0.42f), Vec2(radius, 0.42f), Vec2(radius, 0.3f)},
            24);
    b.material(use.grass);
    b.lathe(std::array{Vec2(radius + 0.01f, 0.33f), Vec2(0.4f * radius, 0.4f), Vec2(0, 0.42f)}, 24);
    b.at(Mat4(1.0f));
}

}  // namespace

void furnish_treasury(Castle& c) {
    MeshBuilder b;
    const float y = kHallFloor;
    const Vec3 brass_at(20.9f, y, 7.1f), glass_at(17.5f, y, 7.4f);
    add_plinth(b, c.use.ashlar, brass_at, 0.7f, 0.62f);
    add_plinth(b, c.use.ashlar, glass_at, 0.5f, 1.0f);
    add_bookshelf(b, c.use, placed({20.5f, y, 1.0f}, 0.0f));
    add_chest(b, c.use, placed({22.55f, y, 3.2f}, -float(kPi) / 2));
    add_chest(b, c.use, placed({16.0f, y, 9.2f}, float(kPi)));
    // A cornice under the ceiling and a skirting, and two engaged columns on the long wall.
    b.material(c.use.ashlar);
    const float x0 = 15.2f, x1 = 23.2f, z0 = 1.0f, z1 = 9.8f, top = 5.5f;
    for (const auto& [low, high] :
         {std::pair{Vec3(x0 - 0.05f, top - 0.35f, z0 - 0.05f), Vec3(x1 + 0.05f, top + 0.05f, z0 + 0.22f)},
          {Vec3(x0 - 0.05f, top - 0.35f, z1 - 0.22f), Vec3(x1 + 0.05f, top + 0.05f, z1 + 0.05f)},
          {Vec3(x0 - 0.05f, top - 0.35f, z0 + 0.1f), Vec3(x0 + 0.22f, top + 0.05f, z1 - 0.1f)},
          {Vec3(x1 - 0.22f, top - 0.35f, z0 + 0.1f), Vec3(x1 + 0.05f, top + 0.05f, z1 - 0.1f)}})
        b.bevel_box(low, high, 0.1f);
    // Plate on the chest's neighbour, a low table of treasure.
    b.material(c.use.oak);
    b.bevel_box({18.0f, y + 0.7f, 1.25f}, {20.0f, y + 0.76f, 1.95f}, 0.01f, Mapping::Grain);
    for (float x : {18.1f, 19.9f})
        for (float z : {1.35f, 1.85f})
            b.bevel_box({x - 0.04f, y, z - 0.04f}, {x + 0.04f, y + 0.71f, z + 0.04f}, 0.008f, Mapping::Grain);
    for (int i = 0; i < 4; ++i)
        add_goblet(b, i % 2 ? c.use.gold : c.use.silver,
                   {18.25f + 0.28f * float(i), y + 0.76f, 1.55f + 0.15f * float(i % 2)}, 0.2f);
    b.at(Vec3(19.6f, y + 0.76f, 1.6f)).material(c.use.gold);
    b.lathe(std::array{Vec2(0, 0), Vec2(0.1f, 0), Vec2(0.1f, 0.02f), Vec2(0.03f, 0.06f), Vec2(0.03f, 0.12f),
                       Vec2(0.24f, 0.22f), Vec2(0.25f, 0.23f), Vec2(0.03f, 0.15f), Vec2(0, 0.15f)},
            28);
    b.at(Mat4(1.0f));
    b.material(c.use.dark_oak);  // ceiling beams
    for (int i = 0; i < 6; ++i) {
        const float x = x0 + 0.9f + 1.24f * float(i);
        b.beam({x, top - 0.12f, z0 - 0.05f}, {x, top - 0.12f, z1 + 0.05f}, 0.22f, 0.3f);
    }
    c.level.add_object(b.take("treasury furniture"));
    add_hanging(b, c, c.use.tapestry, {23.13f, 4.3f, 7.6f}, Facing::West, {2.2f, 3.3f}, 0.02f);
    add_hanging(b, c, c.use.tapestry, {15.27f, 4.3f, 8.2f}, Facing::East, {2.0f, 3.0f}, 0.02f);
    add_shield(b, c.use, c.use.red_wool, {15.2f, 3.1f, 2.6f}, Facing::East);
    add_shield(b, c.use, c.use.blue_wool, {17.2f, 3.3f, 1.0f}, Facing::South);
    c.level.add_object(b.take("treasury hangings"));

    // The glass: a solid drop with a waist, smooth all over.
    std::vector<Vec2> drop;
    for (int i = 0; i <= 28; ++i) {
        const double t = double(i) / 28;
        const double r =
            0.17 * std::sin(kPi * std::pow(t, 0.8)) * (1.0 - 0.25 * t) + 0.02 * std::sin(3 * kPi * t) * (1 - t);
        drop.emplace_back(i == 0 || i == 28 ? 0.0f : float(std::max(r, 0.004)), float(0.52 * t));
    }
    b.at(glass_at + Vec3(0, 1.035f, 0)).material(c.use.glass);
    b.lathe(drop, 40);
    c.level.add_object(b.take("glass drop"));
    b.at(glass_at + Vec3(0, 0.99f, 0)).material(c.use.brass);
    b.torus({0, 0.045f, 0}, 0.075f, 0.018f, 24, 8);
    b.lathe(std::array{Vec2(0, 0.0f), Vec2(0.14f, 0.0f), Vec2(0.14f, 0.02f), Vec2(0.09f, 0.035f), Vec2(0, 0.035f)}, 24);
    c.level.add_object(b.take("glass stand"));

    LevelNode statue;
    statue.name = "brass figure";
    statue.translation = brass_at + Vec3(0, 0.62f, 0);
    statue.rotation = glm::angleAxis(float(-150.0 * kDegree), Vec3(0, 1, 0));
    statue.mesh = c.level.add_mesh(brass_knight(c.use.brass));
    c.level.add_node(statue);
    // A hanging oil lamp keeps the room readable at night.
    const Vec3 lamp(19.2f, 3.5f, 4.9f);
    b.material(c.use.brass);
    b.tube(std::array{lamp + Vec3(0, 0.32f, 0), Vec3(lamp.x, 5.52f, lamp.z)}, 0.012f, 6);
    for (int i = 0; i < 3; ++i) {
        const float a = 2.0944f * float(i);
        b.tube(std::array{lamp + Vec3(0.2f * std::cos(a), -0.1f, 0.2f * std::sin(a)), lamp + Vec3(0, 0.33f, 0)}, 0.007f,
               6);
    }
    b.at(lamp - Vec3(0, 0.2f, 0));
    b.lathe(std::array{Vec2(0, 0), Vec2(0.1f, 0.01f), Vec2(0.2f, 0.09f), Vec2(0.21f, 0.11f), Vec2(0.19f, 0.1f),
                       Vec2(0.1f, 0.05f), Vec2(0, 0.04f)},
            24);
    b.at(Mat4(1.0f));
    add_candle(b, c.use, c.use.oil_flame, lamp - Vec3(0, 0.17f, 0), 0.08f);
    c.level.add_object(b.take("hanging lamp"));
    c.level.add_lamp({"treasury lamp", Rgb(1.0f, 0.58f, 0.25f) * 90.0f},
                     lamp - Vec3(0, 0.28f, 0));  // under the bowl, which would shade the floor
}

void furnish_cellar(Castle& c) {
    MeshBuilder b;
    const float y = kCellarFloor;
    const Vec3 barrels[] = {{-13.6f, y, -2.6f}, {-13.6f, y, -2.0f}, {-7.1f, y, -7.2f},
                            {-6.4f, y, -7.2f},  {2.0f, y, -0.6f},   {4.8f, y, 6.8f},
                            {4.8f, y, 6.1f},    {-9.3f, y, 3.8f},   {0.6f, y, 4.5f}};
    int i = 0;
    for (const Vec3& at : barrels) add_barrel(b, c.use, placed(at, 0.7f * float(i++)));
    add_barrel(b, c.use, placed({-13.55f, y + 0.9f, -2.3f}, 1.3f));
    add_chest(b, c.use, placed({4.6f, y, -7.2f}, 0.0f));
    c.level.add_object(b.take("barrels and chest"));
}

void furnish_courtyard(Castle& c) {
    MeshBuilder b;
    add_well(b, c.use, {1.5f, 0, 2.5f});
    const Vec3 trees[] = {{-7.0f, 0, 3.2f}, {9.2f, 0, -2.2f}};
    for (const Vec3& at : trees) add_planter(b, c.use, at, 1.0f);
    int number = 1;
    for (const Vec3& at : {Vec3(-4.2f, 0, -5.4f), Vec3(5.4f, 0, -5.4f), Vec3(-10.2f, 0, 7.6f), Vec3(10.8f, 0, 7.2f)})
        add_lamp_post(c, b, at, "lamp post " + std::to_string(number++));
    add_barrel(b, c.use, placed({12.9f, 0, 9.9f}, 0.3f));
    add_barrel(b, c.use, placed({12.1f, 0, 10.2f}, 1.1f));
    add_barrel(b, c.use, placed({12.6f, 0.9f, 10.1f}, 2.1f));
    b.material(c.use.dark_oak);  // arcade: a beam over every column, on a corbel in the wall
    for (int i = 1; i < 7; ++i) {
        const float x = -14.0f + 4.0f * float(i);
        b.beam({x, 4.36f, -14.1f}, {x, 4.36f, -10.5f}, 0.24f, 0.32f);
        b.material(c.use.ashlar).bevel_box({x - 0.18f, 3.9f, -14.05f}, {x + 0.18f, 4.22f, -13.72f}, 0.06f);
        b.material(c.use.dark_oak);
    }
    // Stone benches against the walls.
    b.material(c.use.ashlar);
    for (float x : {-6.0f, -1.0f}) {
        b.bevel_box({x, 0.36f, 10.35f}, {x + 2.4f, 0.48f, 10.9f}, 0.025f);
        for (float e : {0.15f, 1.95f}) b.bevel_box({x + e, -0.01f, 10.42f}, {x + e + 0.3f, 0.365f, 10.85f}, 0.02f);
    }
    for (const auto& [at, radius] : {std::pair{Vec3(-3.0f, 0, 10.3f), 0.5f},
                                     {Vec3(2.2f, 0, 10.4f), 0.45f},
                                     {Vec3(13.2f, 0, -0.5f), 0.6f},
                                     {Vec3(13.3f, 0, 1.1f), 0.5f},
                                     {Vec3(13.2f, 0, -8.4f), 0.6f},
                                     {Vec3(-9.0f, 0, 10.3f), 0.55f}})
        add_bush(b, c.use, at, radius, std::uint64_t(number++));
    c.level.add_object(b.take("courtyard things"));

    add_tree(b, c.use, 1, 6.4f, 400);
    const int linden = c.level.add_mesh(b.take("linden"));
    add_tree(b, c.use, 2, 9.5f, 350);
    const int old_linden = c.level.add_mesh(b.take("old linden"));
    const auto plant = [&](int mesh, const Vec3& at, float yaw, float scale) {
        LevelNode node;
        node.name = "tree " + std::to_string(number++);
        node.mesh = mesh;
        node.translation = at;
        node.rotation = glm::angleAxis(yaw, Vec3(0, 1, 0));
        node.scale = Vec3(scale);
        c.level.add_node(node);
    };
    plant(linden, trees[0] + Vec3(0, 0.35f, 0), 0.4f, 1.0f);
    plant(linden, trees[1] + Vec3(0, 0.35f, 0), 2.6f, 0.9f);
    const Vec3 outside[] = {{-31, 0, 18}, {-27, 0, 30}, {-6, 0, 33},   {16, 0, 34.5f}, {32, 0, 24}, {33, 0, -2},
                            {31, 0, -24}, {8, 0, -31},  {-12, 0, -33}, {-33, 0, -26},  {-34, 0, -4}};
    for (const Vec3& at : outside) plant(old_linden, at, 1.7f * float(number), 0.85f + 0.05f * float(number % 5));
}

}  // namespace daylit::content
