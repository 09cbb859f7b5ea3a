#include "engine/scene/tangents.h"

#include <cmath>

namespace daylit {
namespace {

struct TriangleFrame {
    glm::dvec3 tangent = glm::dvec3(0.0);  // direction of growing u
    bool usable = false;
    bool mirrored = false;
};

TriangleFrame triangle_frame(const Primitive& primitive, const std::vector<Vec2>& uvs, const std::uint32_t* corners) {
    const auto position = [&](int i) { return glm::dvec3(primitive.positions[corners[i]]); };
    const auto uv = [&](int i) { return glm::dvec2(uvs[corners[i]]); };
    const glm::dvec3 e1 = position(1) - position(0), e2 = position(2) - position(0);
    const glm::dvec2 d1 = uv(1) - uv(0), d2 = uv(2) - uv(0);
    const double area = d1.x * d2.y - d2.x * d1.y;
    TriangleFrame frame;
    // v grows downwards in glTF while normal maps have +y upwards, so the bitangent points along falling v: a picture
    // seen the right way round has a negative area here and handedness +1.
    frame.mirrored = area > 0;
    frame.tangent = (e1 * d2.y - e2 * d1.y) * (area < 0 ? -1.0 : 1.0);
    const double length = glm::length(frame.tangent);
    frame.usable = area != 0 && length > 0;
    if (frame.usable) frame.tangent /= length;
    return frame;
}

double corner_angle(const Primitive& primitive, const std::uint32_t* corners, int i) {
    const auto position = [&](int k) { return glm::dvec3(primitive.positions[corners[k % 3]]); };
    const glm::dvec3 a = position(i + 1) - position(i), b = position(i + 2) - position(i);
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0 ? std::acos(glm::clamp(glm::dot(a, b) / lengths, -1.0, 1.0)) : 0.0;
}

template <typename T>
void repeat_element(std::vector<T>& values, std::size_t i) {
    if (!values.empty()) values.push_back(T(values[i]));
}

std::uint32_t split_vertex(Primitive& primitive, std::size_t v) {
    const auto copy = std::uint32_t(primitive.positions.size());
    repeat_element(primitive.positions, v);
    repeat_element(primitive.normals, v);
    for (std::vector<Vec2>& set : primitive.uvs) repeat_element(set, v);
    repeat_element(primitive.colors, v);
    repeat_element(primitive.joints, v);
    repeat_element(primitive.weights, v);
    for (MorphTarget& target : primitive.morph_targets) {
        repeat_element(target.positions, v);
        repeat_element(target.normals, v);
        repeat_element(target.tangents, v);
    }
    return copy;
}

}  // namespace

Vec3 any_tangent(const Vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return Vec3(1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x);
}

void make_tangents(Primitive& primitive, int uv_set) {
    const std::size_t vertices = primitive.positions.size();
    std::vector<glm::dvec3> plain(vertices, glm::dvec3(0)), mirrored(vertices, glm::dvec3(0));
    const bool has_uvs = std::size_t(uv_set) < primitive.uvs.size();
    const std::size_t triangles = primitive.indices.size() / 3;
    std::vector<bool> is_mirrored(triangles, false);
    for (std::size_t t = 0; has_uvs && t < triangles; ++t) {
        const std::uint32_t* corners = &primitive.indices[3 * t];
        const TriangleFrame frame = triangle_frame(primitive, primitive.uvs[std::size_t(uv_set)], corners);
        is_mirrored[t] = frame.mirrored;
        if (!frame.usable) continue;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 n(primitive.normals[corners[i]]);
            const glm::dvec3 flat = frame.tangent - n * glm::dot(n, frame.tangent);
            const double length = glm::length(flat);
            if (length > 0)
                (frame.mirrored ? mirrored : plain)[corners[i]] +=
                    flat * (corner_angle(primitive, corners, i) / length);
        }
    }
    const auto tangent = [&](const glm::dvec3& sum, std::size_t v, float handedness) {
        const double length = glm::length(sum);
        return Vec4(length > 1e-12 ? Vec3(sum / length) : any_tangent(primitive.normals[v]), handedness);
    };
    primitive.tangents.resize(vertices);
    std::vector<std::uint32_t> twin(vertices, 0);
    for (std::size_t v = 0; v < vertices; ++v) {
        const bool both = plain[v] != glm::dvec3(0) && mirrored[v] != glm::dvec3(0);
        const bool only_mirrored = plain[v] == glm::dvec3(0) && mirrored[v] != glm::dvec3(0);
        primitive.tangents[v] = only_mirrored ? tangent(mirrored[v], v, -1.0f) : tangent(plain[v], v, 1.0f);
        if (!both) continue;
        twin[v] = split_vertex(primitive, v);
        primitive.tangents.push_back(tangent(mirrored[v], v, -1.0f));
    }
    for (std::size_t i = 0; i < primitive.indices.size(); ++i)
        if (std::uint32_t& index = primitive.indices[i]; is_mirrored[i / 3] && twin[index] != 0) index = twin[index];
}

}  // namespace daylit
