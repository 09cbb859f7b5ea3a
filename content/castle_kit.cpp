// Things that stand in more than one room.
#include <algorithm>
#include <array>
#include <cmath>

#include "content/castle.h"

namespace daylit::content {
namespace {

// Shape of a candle or lamp flame, 1 high, foot at 0.
constexpr std::array<Vec2, 6> kFlame = {Vec2(0, 0),    {0.16f, 0.1f},  {0.2f, 0.28f},
                                        {0.12f, 0.6f}, {0.04f, 0.85f}, {0, 1}};

}  // namespace

void add_candle(MeshBuilder& b, const Palette& use, int flame_material, const Vec3& foot, float height) {
    b.material(use.wax).cylinder(foot, 0.014f, height, 8);
    std::array<Vec2, 6> flame = kFlame;
    for (Vec2& p : flame) p *= 0.055f;
    b.at(foot + Vec3(0, height + 0.004f, 0)).material(flame_material);
    b.lathe(flame, 8);
    b.at(Mat4(1.0f));
}

void add_barrel(MeshBuilder& b, const Palette& use, const Mat4& place) {
    b.at(place).material(use.oak);
    std::vector<Vec2> staves = {{0.0f, 0.04f}, {0.27f, 0.04f}, {0.275f, 0.0f}, {0.3f, 0.0f}};
    for (int i = 1; i <= 5; ++i) {
        const float t = float(i) / 5.0f;
        staves.emplace_back(0.3f + 0.07f * std::sin(float(kPi) * t), 0.9f * t);
    }
    staves.insert(staves.end(), {{0.275f, 0.9f}, {0.27f, 0.86f}, {0.0f, 0.86f}});
    b.lathe(staves, 16);
    b.material(use.iron);
    for (float y : {0.07f, 0.25f, 0.65f, 0.83f}) {
        const float r = 0.3f + 0.07f * std::sin(float(kPi) * y / 0.9f) + 0.002f;
        b.lathe(std::array{Vec2(r, y - 0.025f), Vec2(r + 0.006f, y - 0.025f), Vec2(r + 0.006f, y + 0.025f),
                           Vec2(r, y + 0.025f)},
                16);
    }
    b.at(Mat4(1.0f));
}

void add_chest(MeshBuilder& b, const Palette& use, const Mat4& place) {
    b.at(place).material(use.dark_oak);
    b.bevel_box({-0.6f, 0.04f, -0.3f}, {0.6f, 0.45f, 0.3f}, 0.015f, Mapping::Grain);
    // Rounded lid: half a twelve-sided drum.
    std::vector<Vec3> left, right;
    for (int i = 0; i <= 8; ++i) {
        const double a = kPi * i / 8;
        const float y = 0.46f + 0.2f * float(std::sin(a)), z = 0.31f * float(std::cos(a));
        left.emplace_back(-0.61f, y, z);
        right.emplace_back(0.61f, y, z);
    }
    b.band(right, left, false, 40.0f);
    std::vector<Vec3> right_end(right.rbegin(), right.rend());
    b.flat_polygon(right_end);
    b.flat_polygon(left);
    b.flat_quad(right[0], left[0], left[8], right[8]);
    b.material(use.iron);
    for (float x : {-0.4f, 0.0f, 0.4f}) {
        b.box({x - 0.03f, 0.03f, -0.308f}, {x + 0.03f, 0.452f, 0.308f});
        for (int i = 0; i < 8; ++i) {
            const double a0 = kPi * i / 8, a1 = kPi * (i + 1) / 8;
            const Vec3 p(x, 0.46f + 0.2f * float(std::sin(a0)), 0.31f * float(std::cos(a0)));
            const Vec3 q(x, 0.46f + 0.2f * float(std::sin(a1)), 0.31f * float(std::cos(a1)));
            b.beam(p, q, 0.06f, 0.02f, Vec3(0, std::sin(float(a0 + a1) / 2), std::cos(float(a0 + a1) / 2)));
        }
    }
    b.material(use.brass).bevel_box({-0.06f, 0.33f, 0.305f}, {0.06f, 0.49f, 0.335f}, 0.008f);
    for (float x : {-0.52f, 0.52f})
        for (float z : {-0.24f, 0.24f})
            b.material(use.dark_oak).bevel_box({x - 0.05f, 0, z - 0.05f}, {x + 0.05f, 0.05f, z + 0.05f}, 0.01f);
    b.at(Mat4(1.0f));
}

void add_goblet(MeshBuilder& b, int material, const Vec3& foot, float height) {
    const Vec2 shape[] = {{0, 0},        {0.3f, 0},      {0.3f, 0.03f},  {0.1f, 0.1f},   {0.06f, 0.2f},
                          {0.09f, 0.3f}, {0.06f, 0.38f}, {0.1f, 0.46f},  {0.26f, 0.58f}, {0.31f, 0.75f},
                          {0.3f, 1.0f},  {0.275f, 1.0f}, {0.27f, 0.76f}, {0.2f, 0.6f},   {0, 0.54f}};
    std::vector<Vec2> profile;
    for (const Vec2& p : shape) profile.push_back(p * height);
    b.at(foot).material(material).lathe(profile, 10);
    b.at(Mat4(1.0f));
}

void add_column(MeshBuilder& b, int material, const Vec3& foot, float r, float height) {
    b.at(foot).material(material);
    const float w = 1.35f * r;
    b.bevel_box({-w, -0.02f, -w}, {w, 0.16f, w}, 0.02f);
    const float top = height - 0.16f;
    const std::array profile = {Vec2(0, 0.15f),
                                Vec2(1.32f * r, 0.15f),
                                Vec2(1.36f * r, 0.19f),
                                Vec2(1.32f * r, 0.23f),
                                Vec2(1.14f * r, 0.25f),
                                Vec2(1.18f * r, 0.29f),
                                Vec2(1.12f * r, 0.32f),
                                Vec2(r, 0.34f),
                                Vec2(0.97f * r, 0.6f * height),
                                Vec2(0.92f * r, top - 0.3f),
                                Vec2(1.0f * r, top - 0.29f),
                                Vec2(1.0f * r, top - 0.25f),
                                Vec2(0.92f * r, top - 0.24f),
                                Vec2(1.0f * r, top - 0.12f),
                                Vec2(1.3f * r, top - 0.02f),
                                Vec2(1.36f * r, top + 0.01f),
                                Vec2(0, top + 0.01f)};
    b.lathe(profile, 18);
    b.bevel_box({-w, top, -w}, {w, height + 0.03f, w}, 0.025f);
    b.at(Mat4(1.0f));
}

// A cloth with gentle folds, in front of a wall: centre of its top edge, the direction it faces, its size.
void add_hanging(MeshBuilder& b, const Castle& c, int cloth, const Vec3& top, Facing facing, const Vec2& size,
                 float fold) {
    const Palette& use = c.use;
    const Vec2 picture = c.level.surfaces[std::size_t(cloth)].tile;  // shown once, whatever the size
    Opening frame{.origin = top, .facing = facing, .loops = {}};
    b.at(wall_frame(frame)).material(cloth);
    const auto wave = [=](float s, float t) {
        return fold * (0.35f + 0.65f * (1.0f - t)) * std::sin(s * 15.0f + 1.2f * t);
    };
    const float thick = 0.012f;
    const int columns = 18, rows = 4;
    for (bool back : {false, true})
        b.grid(columns, rows, picture, [=](float s, float t) {
            const float across = back ? 1.0f - s : s;
            return Vec3((across - 0.5f) * size.x, (t - 1.0f) * size.y, wave(across, t) - (back ? thick : 0.0f));
        });
    std::vector<Vec3> front, rear;  // the hem all round closes the cloth
    const auto edge = [&](float s, float t) {
        const Vec3 p((s - 0.5f) * size.x, (t - 1.0f) * size.y, wave(s, t));
        front.push_back(p);
        rear.push_back(p - Vec3(0, 0, thick));
    };
    for (int i = 0; i < columns; ++i) edge(float(i) / columns, 0);
    for (int i = 0; i < rows; ++i) edge(1, float(i) / rows);
    for (int i = columns; i > 0; --i) edge(float(i) / columns, 1);
    for (int i = rows; i > 0; --i) edge(0, float(i) / rows);
    b.band(rear, front, true);
    b.material(use.dark_oak);
    b.tube(std::array{Vec3(-0.5f * size.x - 0.12f, 0.02f, 0), Vec3(0.5f * size.x + 0.12f, 0.02f, 0)}, 0.03f, 8);
    b.material(use.brass);
    for (float x : {-0.5f * size.x - 0.14f, 0.5f * size.x + 0.14f}) b.sphere({x, 0.02f, 0}, 0.05f, 8);
    b.at(Mat4(1.0f));
}

void add_shield(MeshBuilder& b, const Palette& use, int field, const Vec3& centre, Facing facing) {
    Opening frame{.origin = centre, .facing = facing, .loops = {}};
    b.at(wall_frame(frame));
    std::vector<Vec3> rim;
    for (int i = 0; i <= 12; ++i) {  // from the left point down around to the right
        const float t = float(i) / 12.0f, x = -0.36f + 0.72f * t;
        rim.emplace_back(x, -0.1f - 0.42f * std::pow(std::max(std::sin(float(kPi) * t), 0.0f), 0.8f), 0.03f);
    }
    rim.emplace_back(0.36f, 0.38f, 0.03f);
    rim.emplace_back(-0.36f, 0.38f, 0.03f);
    b.material(field);
    const Vec3 boss(0, 0.02f, 0.12f);
    std::vector<Vec3> inner;
    for (const Vec3& p : rim) inner.push_back(glm::mix(boss, p, 0.9f));
    for (std::size_t i = 0; i < rim.size(); ++i) b.flat_triangle(boss, inner[i], inner[(i + 1) % rim.size()]);
    std::vector<Vec3> back;
    for (const Vec3& p : rim) back.emplace_back(p.x, p.y, -0.01f);
    b.material(use.gold);
    b.band(rim, inner, true);
    b.band(back, rim, true);
    b.material(use.steel).sphere({0, 0.02f, 0.1f}, 0.06f, 10);
    b.at(Mat4(1.0f));
}

// The Utah teapot (Martin Newell, 1975): rim, body, lid and bottom are surfaces of revolution of Bezier curves; handle
// and spout are patches mirrored in the plane of symmetry. Control points as published, axis along z there, y here.
void add_teapot(MeshBuilder& b, int material, const Mat4& place, int n) {
    const auto bezier = [](const Vec2* p, float t) {
        const float s = 1.0f - t;
        return p[0] * (s * s * s) + p[1] * (3 * s * s * t) + p[2] * (3 * s * t * t) + p[3] * (t * t * t);
    };
    b.at(place).material(material);
    std::vector<Vec2> profile;  // radius, height; from the bottom's middle over the outside to the rim
    const Vec2 bottom[] = {{0, 0}, {1.425f, 0}, {1.5f, 0.075f}, {1.5f, 0.15f}};
    const Vec2 lower[] = {{1.5f, 0.15f}, {1.5f, 0.225f}, {2.0f, 0.45f}, {2.0f, 0.9f}};
    const Vec2 upper[] = {{2.0f, 0.9f}, {2.0f, 1.35f}, {1.75f, 1.875f}, {1.5f, 2.4f}};
    const Vec2 rim[] = {{1.5f, 2.4f}, {1.4375f, 2.53125f}, {1.3375f, 2.53125f}, {1.4f, 2.4f}};
    for (const Vec2* curve : {bottom, lower, upper, rim})
        for (int i = 0; i < n; ++i) profile.push_back(bezier(curve, float(i) / float(n)));
    profile.insert(profile.end(), {{1.4f, 2.4f}, {1.3f, 2.3f}, {0.0f, 2.3f}});
    b.lathe(profile, 6 * n);
    profile.clear();
    const Vec2 lid[] = {{1.3f, 2.4f}, {1.3f, 2.55f}, {0.4f, 2.55f}, {0.2f, 2.7f}};
    const Vec2 knob[] = {{0.2f, 2.7f}, {0.0f, 2.85f}, {0.8f, 3.15f}, {0.0f, 3.15f}};
    profile.emplace_back(1.3f, 2.28f);
    for (const Vec2* curve : {lid, knob})
        for (int i = 0; i < n; ++i) profile.push_back(bezier(curve, float(i) / float(n)));
    profile.emplace_back(0.0f, 3.15f);
    b.lathe(profile, 6 * n);

    // Each row: outline across at one of four stations along handle or spout; y is the half width.
    const Vec3 patches[4][16] = {{{-1.6f, 0, 2.025f},
                                  {-1.6f, -0.3f, 2.025f},
                                  {-1.5f, -0.3f, 2.25f},
                                  {-1.5f, 0, 2.25f},
                                  {-2.3f, 0, 2.025f},
                                  {-2.3f, -0.3f, 2.025f},
                                  {-2.5f, -0.3f, 2.25f},
                                  {-2.5f, 0, 2.25f},
                                  {-2.7f, 0, 2.025f},
                                  {-2.7f, -0.3f, 2.025f},
                                  {-3.0f, -0.3f, 2.25f},
                                  {-3.0f, 0, 2.25f},
                                  {-2.7f, 0, 1.8f},
                                  {-2.7f, -0.3f, 1.8f},
                                  {-3.0f, -0.3f, 1.8f},
                                  {-3.0f, 0, 1.8f}},
                                 {{-2.7f, 0, 1.8f},
                                  {-2.7f, -0.3f, 1.8f},
                                  {-3.0f, -0.3f, 1.8f},
                                  {-3.0f, 0, 1.8f},
                                  {-2.7f, 0, 1.575f},
                                  {-2.7f, -0.3f, 1.575f},
                                  {-3.0f, -0.3f, 1.35f},
                                  {-3.0f, 0, 1.35f},
                                  {-2.5f, 0, 1.125f},
                                  {-2.5f, -0.3f, 1.125f},
                                  {-2.65f, -0.3f, 0.9375f},
                                  {-2.65f, 0, 0.9375f},
                                  {-2.0f, 0, 0.9f},
                                  {-2.0f, -0.3f, 0.9f},
                                  {-1.9f, -0.3f, 0.6f},
                                  {-1.9f, 0, 0.6f}},
                                 {{1.7f, 0, 1.425f},
                                  {1.7f, -0.66f, 1.425f},
                                  {1.7f, -0.66f, 0.6f},
                                  {1.7f, 0, 0.6f},
                                  {2.6f, 0, 1.425f},
                                  {2.6f, -0.66f, 1.425f},
                                  {3.1f, -0.66f, 0.825f},
                                  {3.1f, 0, 0.825f},
                                  {2.3f, 0, 2.1f},
                                  {2.3f, -0.25f, 2.1f},
                                  {2.4f, -0.25f, 2.025f},
                                  {2.4f, 0, 2.025f},
                                  {2.7f, 0, 2.4f},
                                  {2.7f, -0.25f, 2.4f},
                                  {3.3f, -0.25f, 2.4f},
                                  {3.3f, 0, 2.4f}},
                                 {{2.7f, 0, 2.4f},
                                  {2.7f, -0.25f, 2.4f},
                                  {3.3f, -0.25f, 2.4f},
                                  {3.3f, 0, 2.4f},
                                  {2.8f, 0, 2.475f},
                                  {2.8f, -0.25f, 2.475f},
                                  {3.525f, -0.25f, 2.49375f},
                                  {3.525f, 0, 2.49375f},
                                  {2.9f, 0, 2.475f},
                                  {2.9f, -0.15f, 2.475f},
                                  {3.45f, -0.15f, 2.5125f},
                                  {3.45f, 0, 2.5125f},
                                  {2.8f, 0, 2.4f},
                                  {2.8f, -0.15f, 2.4f},
                                  {3.2f, -0.15f, 2.4f},
                                  {3.2f, 0, 2.4f}}};
    for (std::size_t k = 0; k < 4; ++k)
        for (bool mirrored : {false, true}) {
            std::array<Vec3, 16> points;
            for (std::size_t i = 0; i < 16; ++i) {
                const Vec3& q = patches[k][i];
                points[i] = Vec3(q.x, q.z, mirrored ? -q.y : q.y);
            }
            if (mirrored != (k < 2))  // mirroring turns a patch inside out; walking its rows backwards turns it again
                for (std::size_t row = 0; row < 4; ++row)
                    for (std::size_t i = 0; i < 2; ++i) std::swap(points[4 * row + i], points[4 * row + 3 - i]);
            b.bezier_patch(points, n);
        }
    b.at(Mat4(1.0f));
}

}  // namespace daylit::content
