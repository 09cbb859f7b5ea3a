#include "content/mesh_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace daylit::content {
namespace {

Vec3 face_normal(std::span<const Vec3> corners) {
    Vec3 sum(0.0f);  // Newell's method: right for any planar polygon, whatever its first corner
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        sum += glm::cross(a - corners[0], b - corners[0]);
    }
    const float length = glm::length(sum);
    return length > 0.0f ? sum / length : Vec3(0, 1, 0);
}

// Any unit vector at right angles to n.
Vec3 perpendicular(const Vec3& n) {
    return glm::normalize(glm::cross(n, std::abs(n.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0)));
}

bool sharp(const Vec2& before, const Vec2& after) {
    return glm::dot(glm::normalize(before), glm::normalize(after)) < std::cos(float(40.0 * kDegree));
}

}  // namespace

Vec2 world_uv(const Vec3& p, const Vec3& normal) {
    const Vec3 n = glm::abs(normal);
    if (n.y > n.x && n.y > n.z) return {p.x, p.z};
    if (n.x > n.z) return {normal.x > 0 ? -p.z : p.z, -p.y};
    return {normal.z > 0 ? p.x : -p.x, -p.y};
}

Mat4 placed(const Vec3& translation, float yaw, float scale) {
    Mat4 m(1.0f);
    const float c = std::cos(yaw) * scale, s = std::sin(yaw) * scale;
    m[0] = Vec4(c, 0, -s, 0);
    m[1] = Vec4(0, scale, 0, 0);
    m[2] = Vec4(s, 0, c, 0);
    m[3] = Vec4(translation, 1);
    return m;
}

MeshBuilder& MeshBuilder::material(int index) {
    material_ = index;
    return *this;
}

MeshBuilder& MeshBuilder::at(const Mat4& transform) {
    transform_ = transform;
    normal_transform_ = glm::transpose(glm::inverse(Mat3(transform)));
    return *this;
}

MeshBuilder& MeshBuilder::at(const Vec3& translation) {
    return at(placed(translation));
}

std::uint32_t MeshBuilder::vertex(const Vec3& position, const Vec3& normal, const Vec2& uv) {
    Geometry& g = part();
    g.positions.emplace_back(transform_ * Vec4(position, 1.0f));
    g.normals.push_back(glm::normalize(normal_transform_ * normal));
    g.uvs.push_back(uv);
    return std::uint32_t(g.positions.size()) - 1;
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Geometry& g = part();
    const Vec3 &p = g.positions[a], &q = g.positions[b], &r = g.positions[c];
    if (p == q || q == r || r == p) return;  // poles of lathes and spheres
    g.indices.insert(g.indices.end(), {a, b, c});
}

void MeshBuilder::flat_fan(std::span<const Vec3> corners, const std::function<Vec2(const Vec3&)>& uv) {
    const Vec3 n = face_normal(corners);
    std::vector<std::uint32_t> v;
    for (const Vec3& p : corners) v.push_back(vertex(p, n, uv(p)));
    for (std::size_t i = 1; i + 1 < v.size(); ++i) triangle(v[0], v[i], v[i + 1]);
}

void MeshBuilder::flat_polygon(std::span<const Vec3> corners) {
    const Vec3 n = face_normal(corners);
    flat_fan(corners, [&](const Vec3& p) { return world_uv(p, n); });
}

void MeshBuilder::flat_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    flat_polygon(std::array{a, b, c});
}

void MeshBuilder::flat_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    flat_polygon(std::array{a, b, c, d});
}

void MeshBuilder::picture_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec2& size) {
    const Vec3 n = face_normal(std::array{a, b, c, d});
    const std::uint32_t v[4] = {vertex(a, n, {0, size.y}), vertex(b, n, size), vertex(c, n, {size.x, 0}),
                                vertex(d, n, {0, 0})};
    triangle(v[0], v[1], v[2]);
    triangle(v[0], v[2], v[3]);
}

void MeshBuilder::box(const Vec3& low, const Vec3& high, Mapping mapping) {
    bevel_box(low, high, 0.0f, mapping);
}

void MeshBuilder::bevel_box(const Vec3& low, const Vec3& high, float bevel, Mapping mapping) {
    const Vec3 size = high - low;
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto uv = [&](const Vec3& p, const Vec3& n) {
        if (mapping == Mapping::World) return world_uv(p, n);
        // Across the grain, the sum of the other two coordinates runs on around the edges.
        const int a = (longest + 1) % 3, b = (longest + 2) % 3;
        if (std::abs(n[longest]) > 0.9f) return Vec2(p[a], p[b]);
        return Vec2(p[longest], p[a] + p[b]);
    };
    const auto face = [&](std::span<const Vec3> corners) {
        const Vec3 n = face_normal(corners);
        flat_fan(corners, [&](const Vec3& p) { return uv(p, n); });
    };
    // The corner of the face towards axis f: all but the coordinate f are pulled in by the bevel.
    const auto corner = [&](int bits, int f) {
        Vec3 p;
        for (int k = 0; k < 3; ++k) {
            const bool upper = bits >> k & 1;
            const float in = k == f ? 0.0f : bevel;
            p[k] = upper ? high[k] - in : low[k] + in;
        }
        return p;
    };
    for (int f = 0; f < 3; ++f) {
        const int a = 1 << (f + 1) % 3, b = 1 << (f + 2) % 3, up = 1 << f;
        face(std::array{corner(up, f), corner(up | a, f), corner(up | a | b, f), corner(up | b, f)});
        face(std::array{corner(0, f), corner(b, f), corner(a | b, f), corner(a, f)});
    }
    if (bevel <= 0.0f) return;
    for (int f = 0; f < 3; ++f) {  // edges along axis f, between the faces g and h
        const int g = (f + 1) % 3, h = (f + 2) % 3;
        for (int side = 0; side < 4; ++side) {
            const int bits = (side & 1 ? 1 << g : 0) | (side & 2 ? 1 << h : 0), end = bits | 1 << f;
            const bool flip = ((side & 1) != 0) != ((side & 2) != 0);
            const std::array<Vec3, 4> strip = {corner(bits, g), corner(bits, h), corner(end, h), corner(end, g)};
            face(flip ? std::array{strip[3], strip[2], strip[1], strip[0]} : strip);
        }
    }
    for (int bits = 0; bits < 8; ++bits) {
        const bool even = (((bits & 1) + (bits >> 1 & 1) + (bits >> 2 & 1)) & 1) == 0;
        const Vec3 x = corner(bits, 0), y = corner(bits, 1), z = corner(bits, 2);
        face(even ? std::array{x, z, y} : std::array{x, y, z});
    }
}

void MeshBuilder::beam(const Vec3& from, const Vec3& to, float width, float height, const Vec3& up) {
    const Vec3 along = glm::normalize(to - from);
    const Vec3 side = glm::normalize(glm::cross(along, up)), top = glm::cross(side, along);
    const Mat4 before = transform_;
    Mat4 frame(1.0f);
    frame[0] = Vec4(along, 0);
    frame[1] = Vec4(top, 0);
    frame[2] = Vec4(side, 0);
    frame[3] = Vec4(from, 1);
    at(before * frame);
    const float bevel = 0.08f * std::min(width, height);
    bevel_box({0, -height / 2, -width / 2}, {glm::length(to - from), height / 2, width / 2}, bevel, Mapping::Grain);
    at(before);
}

void MeshBuilder::lathe(std::span<const Vec2> profile, int segments) {
    float widest = 0.0f;
    for (const Vec2& p : profile) widest = std::max(widest, p.x);
    float length = 0.0f;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const Vec2 d = profile[i + 1] - profile[i];
        if (glm::length(d) <= 0.0f) continue;
        // The outward side of a profile walked upwards is to its right.
        const auto normal_of = [](const Vec2& step) { return glm::normalize(Vec2(step.y, -step.x)); };
        Vec2 n0 = normal_of(d), n1 = n0;
        if (i > 0 && !sharp(profile[i] - profile[i - 1], d))
            n0 = glm::normalize(n0 + normal_of(profile[i] - profile[i - 1]));
        if (i + 2 < profile.size() && !sharp(d, profile[i + 2] - profile[i + 1]))
            n1 = glm::normalize(n1 + normal_of(profile[i + 2] - profile[i + 1]));
        std::vector<std::uint32_t> lower, upper;
        for (int s = 0; s <= segments; ++s) {
            const double angle = 2.0 * kPi * (s % segments) / segments;
            const float c = float(std::cos(angle)), w = float(std::sin(angle));
            const float u = float(2.0 * kPi * s / segments) * widest;
            const auto put = [&](const Vec2& p, const Vec2& n, float v) {
                return vertex({p.x * c, p.y, -p.x * w}, {n.x * c, n.y, -n.x * w}, {u, v});
            };
            lower.push_back(put(profile[i], n0, -length));
            upper.push_back(put(profile[i + 1], n1, -length - glm::length(d)));
        }
        for (std::size_t s = 0; s < std::size_t(segments); ++s) {
            triangle(lower[s], lower[s + 1], upper[s + 1]);
            triangle(lower[s], upper[s + 1], upper[s]);
        }
        length += glm::length(d);
    }
}

void MeshBuilder::sphere(const Vec3& centre, float radius, int segments) {
    std::vector<Vec2> profile;
    for (int i = 0; i <= segments / 2; ++i) {
        const double a = kPi * i / (segments / 2);
        const bool pole = i == 0 || i == segments / 2;
        profile.emplace_back(pole ? 0.0f : float(std::sin(a)) * radius, -float(std::cos(a)) * radius);
    }
    const Mat4 before = transform_;
    at(before * placed(centre));
    lathe(profile, segments);
    at(before);
}

void MeshBuilder::cylinder(const Vec3& base, float radius, float height, int segments) {
    const Mat4 before = transform_;
    at(before * placed(base));
    lathe(std::array{Vec2(0, 0), Vec2(radius, 0), Vec2(radius, height), Vec2(0, height)}, segments);
    at(before);
}

void MeshBuilder::tube(std::span<const Vec3> path, std::span<const float> radii, int segments) {
    const std::size_t count = path.size();
    std::vector<std::vector<std::uint32_t>> rings;
    Vec3 side = perpendicular(glm::normalize(path[1] - path[0]));
    float length = 0.0f;
    std::vector<Vec3> along;
    std::vector<std::vector<Vec3>> points;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 step = path[std::min(i + 1, count - 1)] - path[i == 0 ? 0 : i - 1];
        along.push_back(glm::normalize(step));
        side = glm::normalize(side - along[i] * glm::dot(side, along[i]));  // carried along without twist
        const Vec3 other = glm::cross(along[i], side);
        if (i > 0) length += glm::length(path[i] - path[i - 1]);
        rings.emplace_back();
        points.emplace_back();
        for (int s = 0; s <= segments; ++s) {
            const double a = 2.0 * kPi * (s % segments) / segments;
            const Vec3 n = side * float(std::cos(a)) + other * float(std::sin(a));
            const Vec3 p = path[i] + n * radii[i];
            if (s < segments) points.back().push_back(p);
            rings.back().push_back(vertex(p, n, {length, float(s) / segments * 6.2832f * radii[0]}));
        }
    }
    for (std::size_t i = 0; i + 1 < count; ++i)
        for (std::size_t s = 0; s < std::size_t(segments); ++s) {
            triangle(rings[i][s], rings[i][s + 1], rings[i + 1][s + 1]);
            triangle(rings[i][s], rings[i + 1][s + 1], rings[i + 1][s]);
        }
    const auto cap = [&](std::size_t i, const Vec3& n, bool reverse) {
        if (radii[i] <= 0.0f) return;
        std::vector<Vec3> corners = points[i];
        if (reverse) std::reverse(corners.begin(), corners.end());
        flat_fan(corners, [&](const Vec3& p) { return world_uv(p, n); });
    };
    cap(0, -along.front(), true);
    cap(count - 1, along.back(), false);
}

void MeshBuilder::tube(std::span<const Vec3> path, float radius, int segments) {
    const std::vector<float> radii(path.size(), radius);
    tube(path, radii, segments);
}

void MeshBuilder::torus(const Vec3& centre, float ring_radius, float tube_radius, int ring_segments,
                        int tube_segments) {
    std::vector<std::vector<std::uint32_t>> rings;
    for (int r = 0; r <= ring_segments; ++r) {
        const double a = 2.0 * kPi * (r % ring_segments) / ring_segments;
        const Vec3 out(float(std::cos(a)), 0, -float(std::sin(a)));
        rings.emplace_back();
        for (int t = 0; t <= tube_segments; ++t) {
            const double b = 2.0 * kPi * (t % tube_segments) / tube_segments;
            const Vec3 n = out * float(std::cos(b)) + Vec3(0, float(std::sin(b)), 0);
            rings.back().push_back(vertex(
                centre + out * ring_radius + n * tube_radius, n,
                {float(r) / ring_segments * 6.2832f * ring_radius, float(t) / tube_segments * 6.2832f * tube_radius}));
        }
    }
    for (std::size_t r = 0; r < std::size_t(ring_segments); ++r)
        for (std::size_t t = 0; t < std::size_t(tube_segments); ++t) {
            triangle(rings[r][t], rings[r + 1][t], rings[r + 1][t + 1]);
            triangle(rings[r][t], rings[r + 1][t + 1], rings[r][t + 1]);
        }
}

void MeshBuilder::grid(int columns, int rows, const Vec2& size, const std::function<Vec3(float, float)>& f) {
    const float e = 1e-3f;
    const auto normal = [&](float s, float t) {
        const Vec3 ds = f(std::min(s + e, 1.0f), t) - f(std::max(s - e, 0.0f), t);
        const Vec3 dt = f(s, std::min(t + e, 1.0f)) - f(s, std::max(t - e, 0.0f));
        const Vec3 n = glm::cross(ds, dt);
        const float l = glm::length(n);
        return l > 1e-12f ? n / l : Vec3(0, 1, 0);
    };
    std::vector<std::uint32_t> v;
    for (int r = 0; r <= rows; ++r)
        for (int c = 0; c <= columns; ++c) {
            const float s = float(c) / float(columns), t = float(r) / float(rows);
            v.push_back(vertex(f(s, t), normal(s, t), {s * size.x, (1.0f - t) * size.y}));
        }
    const auto at_cell = [&](int c, int r) { return v[std::size_t(r * (columns + 1) + c)]; };
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            triangle(at_cell(c, r), at_cell(c + 1, r), at_cell(c + 1, r + 1));
            triangle(at_cell(c, r), at_cell(c + 1, r + 1), at_cell(c, r + 1));
        }
}

void MeshBuilder::band(std::span<const Vec3> near, std::span<const Vec3> far, bool closed, float smooth_degrees) {
    const std::size_t count = near.size(), faces = closed ? count : count - 1;
    const float limit = std::cos(float(smooth_degrees * kDegree));
    std::vector<Vec3> normals;
    for (std::size_t i = 0; i < faces; ++i) {
        const std::size_t j = (i + 1) % count;
        normals.push_back(face_normal(std::array{near[i], near[j], far[j], far[i]}));
    }
    float length = 0.0f;
    for (std::size_t i = 0; i < faces; ++i) {
        const std::size_t j = (i + 1) % count;
        const float step = std::max(glm::length(near[j] - near[i]), glm::length(far[j] - far[i]));
        if (step <= 1e-6f) continue;
        const auto smoothed = [&](std::size_t other, bool exists) {
            return exists && glm::dot(normals[i], normals[other]) > limit ? glm::normalize(normals[i] + normals[other])
                                                                          : normals[i];
        };
        const Vec3 n0 = smoothed((i + faces - 1) % faces, closed || i > 0);
        const Vec3 n1 = smoothed((i + 1) % faces, closed || i + 1 < faces);
        const float depth = glm::length(far[i] - near[i]);
        const std::uint32_t a = vertex(near[i], n0, {length, 0}), b = vertex(near[j], n1, {length + step, 0});
        const std::uint32_t c = vertex(far[j], n1, {length + step, -depth}), d = vertex(far[i], n0, {length, -depth});
        triangle(a, b, c);
        triangle(a, c, d);
        length += step;
    }
}

void MeshBuilder::bezier_patch(std::span<const Vec3, 16> p, int divisions) {
    const auto cubic = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, float t) {
        const float s = 1.0f - t;
        return a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t);
    };
    grid(divisions, divisions, Vec2(0.3f), [&](float s, float t) {
        Vec3 row[4];
        for (std::size_t r = 0; r < 4; ++r) row[r] = cubic(p[4 * r], p[4 * r + 1], p[4 * r + 2], p[4 * r + 3], s);
        return cubic(row[0], row[1], row[2], row[3], t);
    });
}

LevelMesh MeshBuilder::take(const std::string& name) {
    LevelMesh mesh = std::exchange(mesh_, {});
    mesh.name = name;
    std::erase_if(mesh.parts, [](const auto& part) { return part.second.indices.empty(); });
    at(Mat4(1.0f));
    return mesh;
}

}  // namespace daylit::content
