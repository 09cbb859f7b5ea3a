#include "content/opening.h"

#include <algorithm>
#include <cmath>

namespace daylit::content {
namespace {

constexpr int kHeadSteps = 12;              // even, so that the middle of the head is a point
constexpr float kPointedRise = 0.8660254f;  // equilateral arch: both arcs have the width as radius
constexpr float kSegmentalRise = 0.2f;

// Point of the head at t in [0,1], from the right springing to the left; relative to the middle of the springing line.
Vec2 head_point(Head head, float width, float t) {
    const float half = 0.5f * width;
    const auto arc = [](float radius, double angle) {
        return Vec2(float(std::cos(angle)) * radius, float(std::sin(angle)) * radius);
    };
    switch (head) {
        case Head::Flat:
            return {half - width * t, 0.0f};
        case Head::Segmental: {
            const float rise = kSegmentalRise * width, radius = (half * half + rise * rise) / (2.0f * rise);
            const double limit = std::asin(double(half / radius));
            return arc(radius, kPi / 2 + (2.0 * t - 1.0) * limit) - Vec2(0, radius - rise);
        }
        case Head::Round:
            return arc(half, kPi * t);
        case Head::Pointed:
            return t <= 0.5f ? arc(width, kPi / 3 * (2.0 * t)) - Vec2(half, 0)
                             : arc(width, kPi - kPi / 3 * (2.0 - 2.0 * t)) + Vec2(half, 0);
    }
    return {};
}

std::vector<Vec3> at_depth(const std::vector<Vec2>& points, float depth) {
    std::vector<Vec3> result;
    for (const Vec2& p : points) result.emplace_back(p, -depth);
    return result;
}

struct Rect {
    Vec2 low, high;
};

Rect bounds_of(const std::vector<Loop>& loops) {
    Rect r{loops[0].points[0], loops[0].points[0]};
    for (const Loop& loop : loops)
        for (const Vec2& p : loop.points) r.low = glm::min(r.low, p), r.high = glm::max(r.high, p);
    return r;
}

// The wall's face between the cut rectangle and the outline, at one depth.
void fill_around(MeshBuilder& builder, const Rect& r, const Loop& loop, bool outer) {
    const auto triangle = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
        const Vec2 e = b - a, f = c - a;
        if (std::abs(e.x * f.y - e.y * f.x) < 1e-6f) return;
        const Vec3 p(a, -loop.depth), q(b, -loop.depth), s(c, -loop.depth);
        if (outer)
            builder.flat_triangle(p, q, s);
        else
            builder.flat_triangle(p, s, q);
    };
    // Every edge of the (convex) outline belongs to the corner that it faces; where the corner changes, a triangle
    // reaches from one corner to the next.
    const auto& o = loop.points;
    const Vec2 corners[4] = {{r.high.x, r.low.y}, r.high, {r.low.x, r.high.y}, r.low};
    const auto corner_of = [&](std::size_t i) {
        const Vec2 d = o[(i + 1) % o.size()] - o[i], n(d.y, -d.x);
        if (n.y < 0.0f) return n.x >= 0.0f ? 0 : 3;
        if (n.y > 0.0f) return n.x > 0.0f ? 1 : 2;
        return n.x > 0.0f ? 1 : 3;
    };
    int corner = corner_of(o.size() - 1);
    for (std::size_t i = 0; i < o.size(); ++i) {
        for (const int next = corner_of(i); corner != next; corner = (corner + 1) % 4)
            triangle(corners[corner], corners[(corner + 1) % 4], o[i]);
        triangle(corners[corner], o[(i + 1) % o.size()], o[i]);
    }
}

}  // namespace

float head_height(Head head, float width) {
    switch (head) {
        case Head::Flat:
            return 0.0f;
        case Head::Segmental:
            return kSegmentalRise * width;
        case Head::Round:
            return 0.5f * width;
        case Head::Pointed:
            return kPointedRise * width;
    }
    return 0.0f;
}

std::vector<Vec2> outline(Head head, float width, float bottom, float spring) {
    std::vector<Vec2> points{{-0.5f * width, bottom}, {0.5f * width, bottom}, {0.5f * width, spring}};
    for (int i = 1; i < kHeadSteps; ++i)
        points.push_back(head_point(head, width, float(i) / kHeadSteps) + Vec2(0, spring));
    points.emplace_back(-0.5f * width, spring);
    return points;
}

std::vector<Vec2> circle_outline(float radius, float centre_y) {
    const int steps = 32;
    const double gap = 0.005;  // half the angle of the short bottom
    std::vector<Vec2> points;
    for (int i = 0; i <= steps; ++i) {
        const double a = -kPi / 2 + gap + (2.0 * kPi - 2.0 * gap) * i / steps;
        points.emplace_back(radius * float(std::cos(a)), centre_y + radius * float(std::sin(a)));
    }
    std::rotate(points.begin(), points.end() - 1, points.end());
    return points;
}

Mat4 wall_frame(const Opening& o) {
    const float yaw = o.facing == Facing::South   ? 0.0f
                      : o.facing == Facing::East  ? 1.0f
                      : o.facing == Facing::North ? 2.0f
                                                  : 3.0f;
    Mat4 m(1.0f);
    const float c[4] = {1, 0, -1, 0}, s[4] = {0, 1, 0, -1};  // exact quarter turns keep walls on the grid
    const int k = int(yaw);
    m[0] = Vec4(c[k], 0, -s[k], 0);
    m[2] = Vec4(s[k], 0, c[k], 0);
    m[3] = Vec4(o.origin, 1);
    return m;
}

void add_opening(Blocks& blocks, MeshBuilder& builder, const Opening& o) {
    const Rect r = bounds_of(o.loops);
    const Mat4 frame = wall_frame(o);
    const Vec3 a(frame * Vec4(r.low, 0, 1)), b(frame * Vec4(r.high, -o.thickness, 1));
    blocks.cover(glm::min(a, b), glm::max(a, b), o.room);

    // Texture coordinates are taken in world space, so that courses run on around the opening.
    const auto world = [&](std::vector<Vec3> points) {
        for (Vec3& p : points) p = Vec3(frame * Vec4(p, 1));
        return points;
    };
    MeshBuilder flush;
    flush.at(frame);
    flush.material(o.outer_wall);
    fill_around(flush, r, o.loops.front(), true);
    flush.material(o.inner_wall);
    fill_around(flush, r, o.loops.back(), false);
    LevelMesh faces = flush.take("");
    builder.at(Mat4(1.0f));
    for (const auto& [material, g] : faces.parts) {
        builder.material(material);
        for (std::size_t i = 0; i < g.indices.size(); i += 3)
            builder.flat_triangle(g.positions[g.indices[i]], g.positions[g.indices[i + 1]],
                                  g.positions[g.indices[i + 2]]);
    }
    for (std::size_t i = 0; i + 1 < o.loops.size(); ++i) {
        std::vector<Vec3> near = world(at_depth(o.loops[i].points, o.loops[i].depth));
        std::vector<Vec3> far = world(at_depth(o.loops[i + 1].points, o.loops[i + 1].depth));
        if (!o.open_bottom) {
            builder.material(o.sill);
            builder.flat_quad(near[0], near[1], far[1], far[0]);
        }
        // Sides and head: from the bottom right over the head to the bottom left.
        std::rotate(near.begin(), near.begin() + 1, near.end());
        std::rotate(far.begin(), far.begin() + 1, far.end());
        builder.material(o.reveal);
        builder.band(near, far, false);
    }
}

void back_inner_seam(MeshBuilder& builder, const Opening& o) {
    constexpr float kBehind = 0.008f, kWider = 0.01f;
    Loop loop = o.loops.back();
    loop.depth -= kBehind;
    Rect r = bounds_of(o.loops);
    r.low -= Vec2(kWider, o.open_bottom ? 0.0f : kWider);
    r.high += kWider;
    builder.at(wall_frame(o)).material(o.inner_wall);
    fill_around(builder, r, loop, false);
    builder.at(Mat4(1.0f));
}

void add_surround(MeshBuilder& builder, const Opening& o, bool inside, float width, float rise, int material) {
    const std::vector<Vec2>& inner = (inside ? o.loops.back() : o.loops.front()).points;
    const float face = inside ? o.thickness : 0.0f, out = inside ? -1.0f : 1.0f;
    // Outward offset of the open line from bottom right to bottom left.
    std::vector<Vec2> line(inner.begin() + 1, inner.end());
    line.push_back(inner[0]);
    std::vector<Vec2> wide;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const auto normal = [&](std::size_t k) {
            const Vec2 d = glm::normalize(line[k + 1] - line[k]);
            return Vec2(d.y, -d.x);
        };
        const Vec2 n0 = normal(i > 0 ? i - 1 : 0), n1 = normal(i + 1 < line.size() ? i : i - 1);
        const Vec2 sum = n0 + n1;
        wide.push_back(line[i] + sum * (2.0f * width / glm::dot(sum, sum)));
    }
    const auto lifted = [&](const std::vector<Vec2>& points, float height, float inset) {
        std::vector<Vec3> result;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vec2 p = points[i] + (line[i] - wide[i]) * (inset / width);
            result.emplace_back(p, -face + out * height);
        }
        return result;
    };
    builder.at(wall_frame(o));
    builder.material(material);
    // Section from the opening's edge outwards: a chamfer up, a flat, a step down into the wall.
    const std::vector<Vec3> section[5] = {lifted(line, -0.002f, 0.0f), lifted(line, 0.6f * rise, 0.0f),
                                          lifted(line, rise, -0.3f * width), lifted(wide, rise, 0.0f),
                                          lifted(wide, -0.01f, 0.0f)};
    for (int i = 0; i < 4; ++i) {
        if (out > 0)
            builder.band(section[i + 1], section[i], false);
        else
            builder.band(section[i], section[i + 1], false);
    }
    builder.at(Mat4(1.0f));
}

void add_tracery(MeshBuilder& builder, const Opening& o, const Loop& loop, Head head, float spring, const Tracery& t) {
    builder.at(wall_frame(o));
    const float left = loop.points[0].x, right = loop.points[1].x, bottom = loop.points[0].y;
    const float width = right - left, z = -t.depth;
    const auto bar = [&](const std::vector<Vec2>& line, float radius) {
        std::vector<Vec3> path;
        for (const Vec2& p : line) path.emplace_back(p, z);
        builder.tube(path, radius, t.sides);
    };
    const auto shifted = [](std::vector<Vec2> points, const Vec2& by) {
        for (Vec2& p : points) p += by;
        return points;
    };
    builder.material(t.bar_material);
    const float pane = width / float(t.lights);
    for (int i = 1; i < t.lights; ++i) {
        const float x = left + pane * float(i);
        bar({{x, bottom - 0.02f}, {x, spring}}, t.bar);
    }
    for (int i = 1; i <= t.transoms; ++i) {
        const float y = bottom + (spring - bottom) * float(i) / float(t.transoms + 1);
        bar({{left - 0.02f, y}, {right + 0.02f, y}}, 0.7f * t.bar);
    }
    if (head != Head::Flat && t.lights > 1) {
        // A lesser arch over each light, and a ring in the spandrel above them.
        const Head lesser = head == Head::Pointed ? Head::Pointed : Head::Round;
        for (int i = 0; i < t.lights; ++i) {
            const float x = left + pane * (float(i) + 0.5f);
            std::vector<Vec2> arch = shifted(outline(lesser, pane, 0, spring), {x, 0});
            bar(std::vector<Vec2>(arch.begin() + 2, arch.end()), t.bar);
        }
        const float crown = spring + head_height(head, width), lesser_crown = spring + head_height(lesser, pane);
        const float radius = 0.42f * (crown - lesser_crown), y = lesser_crown + 0.5f * (crown - lesser_crown);
        std::vector<Vec2> ring;
        for (int i = 0; i <= 16; ++i) {
            const double a = 2.0 * kPi * i / 16;
            ring.emplace_back(radius * float(std::cos(a)), y + radius * float(std::sin(a)));
        }
        bar(ring, t.bar);
    }
    if (t.sheet_material >= 0) {
        builder.material(t.sheet_material);
        builder.flat_polygon(at_depth(loop.points, t.depth - 0.5f * t.sheet_thickness));
        if (t.sheet_thickness > 0.0f) {
            const std::vector<Vec3> inner = at_depth(loop.points, t.depth + 0.5f * t.sheet_thickness);
            builder.flat_polygon(std::vector<Vec3>(inner.rbegin(), inner.rend()));
        }
    }
    builder.at(Mat4(1.0f));
}

}  // namespace daylit::content
