#include "demo/walk/collider.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daylit {
namespace {

constexpr std::uint32_t kLeafSize = 4;

bool finite(const Vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool overlap(const Bounds& a, const Bounds& b) {
    return a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y && a.min.z <= b.max.z &&
           a.max.z >= b.min.z;
}

struct PointPair {
    Vec3 on_axis, on_triangle;
    float distance2() const { return glm::dot(on_axis - on_triangle, on_axis - on_triangle); }
};

/// Ericson 2005, Real-Time Collision Detection, 5.1.5.
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const float scale = 1.0f / (va + vb + vc);
    return a + ab * (vb * scale) + ac * (vc * scale);
}

/// Ericson 2005, 5.1.9: closest points of the segments p + s d1 and q + t d2, 0 <= s, t <= 1; both longer than zero.
PointPair closest_on_segments(const Vec3& p, const Vec3& d1, const Vec3& q, const Vec3& d2) {
    const Vec3 r = p - q;
    const float a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, r);
    const float b = glm::dot(d1, d2), c = glm::dot(d1, r), denominator = a * e - b * b;
    float s = denominator > 1e-12f * a * e ? std::clamp((b * f - c * e) / denominator, 0.0f, 1.0f) : 0.0f;
    float t = (b * s + f) / e;
    if (t < 0 || t > 1) {
        t = std::clamp(t, 0.0f, 1.0f);
        s = std::clamp((b * t - c) / a, 0.0f, 1.0f);
    }
    return {p + d1 * s, q + d2 * t};
}

/// Where the vertical line through p meets the triangle, and whether it does.
std::optional<float> height_at(float x, float z, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double abx = double(b.x) - a.x, abz = double(b.z) - a.z, acx = double(c.x) - a.x, acz = double(c.z) - a.z;
    const double area = abx * acz - abz * acx;
    if (area == 0) return {};
    const double px = double(x) - a.x, pz = double(z) - a.z;
    const double v = (px * acz - pz * acx) / area, w = (abx * pz - abz * px) / area;
    // A line through a shared edge must find one of its triangles.
    constexpr double kEdge = -1e-6;
    if (v < kEdge || w < kEdge || v + w > 1 - kEdge) return {};
    return float(a.y + v * (double(b.y) - a.y) + w * (double(c.y) - a.y));
}

PointPair closest_pair(const Vec3& bottom, const Vec3& top, const Vec3& a, const Vec3& b, const Vec3& c) {
    if (const auto y = height_at(bottom.x, bottom.z, a, b, c); y && *y > bottom.y && *y < top.y) {
        const Vec3 crossing(bottom.x, *y, bottom.z);
        return {crossing, crossing};
    }
    PointPair best{bottom, closest_on_triangle(bottom, a, b, c)};
    const auto consider = [&](const PointPair& pair) {
        if (pair.distance2() < best.distance2()) best = pair;
    };
    consider({top, closest_on_triangle(top, a, b, c)});
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        if (from != to) consider(closest_on_segments(bottom, top - bottom, from, to - from));
    }
    return best;
}

}  // namespace

Collider::Collider(const WorldMesh& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const Triangle t{mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                         mesh.positions[mesh.indices[i + 2]]};
        const Vec3 area = glm::cross(t.b - t.a, t.c - t.a);
        if (!finite(t.a) || !finite(t.b) || !finite(t.c) || !(glm::dot(area, area) > 0)) continue;
        triangles_.push_back(t);
        for (const Vec3& corner : {t.a, t.b, t.c}) bounds_.add(corner);
    }
    if (!triangles_.empty()) build(0, std::uint32_t(triangles_.size()));
}

void Collider::build(std::uint32_t first, std::uint32_t count) {
    const std::size_t index = nodes_.size();
    nodes_.push_back({});
    Bounds centres;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Triangle& t = triangles_[i];
        for (const Vec3& corner : {t.a, t.b, t.c}) nodes_[index].box.add(corner);
        centres.add((t.a + t.b + t.c) / 3.0f);
    }
    if (count <= kLeafSize) {
        nodes_[index].first = first;
        nodes_[index].count = count;
        return;
    }
    const Vec3 size = centres.max - centres.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t half = count / 2;
    const auto begin = triangles_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [axis](const Triangle& s, const Triangle& t) {
        return s.a[axis] + s.b[axis] + s.c[axis] < t.a[axis] + t.b[axis] + t.c[axis];
    });
    build(first, half);
    nodes_[index].second_child = std::uint32_t(nodes_.size());
    build(first + half, count - half);
}

template <typename Visit>
void Collider::visit(const Bounds& box, const Visit& per_triangle) const {
    if (nodes_.empty()) return;
    // The tree is halved at every level, so it is no deeper than 32 and the stack no fuller.
    std::array<std::uint32_t, 64> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const std::uint32_t index = stack[--size];
        const Node& node = nodes_[index];
        if (!overlap(node.box, box)) continue;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) per_triangle(triangles_[i]);
        if (node.count > 0) continue;
        stack[size++] = node.second_child;
        stack[size++] = index + 1;
    }
}

std::optional<Contact> Collider::deepest_contact(const Capsule& capsule) const {
    const Vec3 top = capsule.bottom + Vec3(0, capsule.height, 0), reach(capsule.radius);
    std::optional<Contact> deepest;
    visit({capsule.bottom - reach, top + reach}, [&](const Triangle& t) {
        const PointPair pair = closest_pair(capsule.bottom, top, t.a, t.b, t.c);
        const float distance = std::sqrt(pair.distance2()), depth = capsule.radius - distance;
        if (depth <= 0 || (deepest && depth <= deepest->depth)) return;
        // With the axis in the triangle's plane either side is as near; its normal decides.
        const Vec3 away = distance > 1e-6f ? (pair.on_axis - pair.on_triangle) / distance
                                           : glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
        deepest = Contact{depth, away};
    });
    return deepest;
}

std::optional<float> Collider::floor_height(float x, float z, float below, float above) const {
    std::optional<float> highest;
    visit({Vec3(x, below, z), Vec3(x, above, z)}, [&](const Triangle& t) {
        const std::optional<float> y = height_at(x, z, t.a, t.b, t.c);
        if (!y || *y < below || *y > above || (highest && *y <= *highest)) return;
        const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
        if (std::abs(normal.y) >= kFloorCosine * glm::length(normal)) highest = y;
    });
    return highest;
}

}  // namespace daylit
