// Triangles of the posed scene in world space.
#include <algorithm>

#include "engine/base/vec.h"
#include "engine/scene/pose.h"

namespace daylit {
namespace {

/// Directions go by the inverse transpose; the cofactor matrix is that times the determinant and exists even for flat
/// scales. Its sign is the determinant's, which keeps mirrored normals outward only after division by it.
Mat3 cofactor(const Mat3& m) {
    return Mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
}

/// A primitive's vertices with morph targets applied, in the mesh's space.
struct Morphed {
    std::vector<Vec3> positions, normals;
    std::vector<Vec4> tangents;
};

Morphed morph(const Primitive& primitive, const std::vector<float>& weights) {
    Morphed result{primitive.positions, primitive.normals, primitive.tangents};
    for (std::size_t t = 0; t < primitive.morph_targets.size() && t < weights.size(); ++t) {
        const MorphTarget& target = primitive.morph_targets[t];
        if (weights[t] == 0.0f) continue;
        for (std::size_t v = 0; v < target.positions.size(); ++v)
            result.positions[v] += weights[t] * target.positions[v];
        for (std::size_t v = 0; v < target.normals.size(); ++v) result.normals[v] += weights[t] * target.normals[v];
        for (std::size_t v = 0; v < target.tangents.size() && v < result.tangents.size(); ++v)
            result.tangents[v] += Vec4(weights[t] * target.tangents[v], 0.0f);
    }
    return result;
}

class Builder {
  public:
    Builder(const Scene& scene, const Pose& pose) : scene_(scene), pose_(pose) {}

    void add_node(int n) {
        const Node& node = scene_.nodes[std::size_t(n)];
        const Mesh& mesh = scene_.meshes[std::size_t(node.mesh)];
        const Mat4& world = pose_.world_from_node[std::size_t(n)];
        const bool skinned = node.skin != -1;
        if (skinned) joints_ = skin_matrices(scene_, pose_, n);
        if (node.instances.empty()) return add_mesh(n, mesh, world, skinned);
        for (const Mat4& instance : node.instances) add_mesh(n, mesh, world * instance, skinned);
    }
    WorldMesh take() { return std::move(out_); }

  private:
    void add_mesh(int n, const Mesh& mesh, const Mat4& world, bool skinned) {
        for (const Primitive& primitive : mesh.primitives) {
            if (primitive.topology != Topology::Triangles) continue;
            const auto first = std::uint32_t(out_.positions.size());
            add_vertices(primitive, morph(primitive, pose_.morph_weights[std::size_t(n)]), world,
                         skinned && !primitive.joints.empty());
            const bool mirrored = !skinned && glm::determinant(glm::dmat3(world)) < 0;
            add_triangles(primitive, first, mirrored, std::uint32_t(n));
        }
    }

    void add_vertices(const Primitive& primitive, const Morphed& morphed, const Mat4& world, bool skinned) {
        const std::size_t count = primitive.positions.size();
        Mat4 matrix = world;
        Mat3 normal_matrix = oriented_cofactor(world);
        for (std::size_t v = 0; v < count; ++v) {
            if (skinned) {
                matrix = Mat4(0.0f);
                for (int i = 0; i < 4; ++i)
                    matrix += primitive.weights[v][i] * joints_[primitive.joints[v][std::size_t(i)]];
                normal_matrix = oriented_cofactor(matrix);
            }
            out_.positions.push_back(Vec3(matrix * Vec4(morphed.positions[v], 1.0f)));
            out_.normals.push_back(unit_or(normal_matrix * morphed.normals[v], Vec3(0, 1, 0)));
            Vec4 tangent(0.0f);
            if (!morphed.tangents.empty())
                tangent = Vec4(unit_or(Mat3(matrix) * Vec3(morphed.tangents[v]), Vec3(1, 0, 0)), morphed.tangents[v].w);
            // A mirror turns the bitangent cross(n, t) * w round.
            if (mirror_) tangent.w = -tangent.w;
            out_.tangents.push_back(tangent);
            const auto uv = [&](std::size_t set) {
                return set < primitive.uvs.size() ? primitive.uvs[set][v] : Vec2(0.0f);
            };
            out_.uvs.push_back({uv(0), uv(1)});
            out_.colors.push_back(primitive.colors.empty() ? Rgba(1.0f) : primitive.colors[v]);
        }
    }

    void add_triangles(const Primitive& primitive, std::uint32_t first, bool mirrored, std::uint32_t node) {
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const std::uint32_t a = primitive.indices[i], b = primitive.indices[i + 1], c = primitive.indices[i + 2];
            out_.indices.insert(out_.indices.end(),
                                {first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
            out_.materials.push_back(std::uint32_t(primitive.material));
            out_.nodes.push_back(node);
        }
    }

    Mat3 oriented_cofactor(const Mat4& matrix) {
        const Mat3 linear(matrix);
        mirror_ = glm::determinant(glm::dmat3(linear)) < 0;
        return mirror_ ? -cofactor(linear) : cofactor(linear);
    }

    const Scene& scene_;
    const Pose& pose_;
    std::vector<Mat4> joints_;
    bool mirror_ = false;  // of the last matrix
    WorldMesh out_;
};

bool is_part(const Node& node, Part part) {
    return node.mesh != -1 && (part == Part::All || node.dynamic == (part == Part::Dynamic));
}

}  // namespace

WorldMesh world_mesh(const Scene& scene, const Pose& pose, Part part) {
    Builder builder(scene, pose);
    for (const int n : scene.order)
        if (is_part(scene.nodes[std::size_t(n)], part)) builder.add_node(n);
    return builder.take();
}

std::vector<PlacedMesh> placed_meshes(const Scene& scene, Part part) {
    std::vector<PlacedMesh> placed;
    std::size_t triangle = 0;
    for (const int n : scene.order) {
        const Node& node = scene.nodes[std::size_t(n)];
        if (!is_part(node, part)) continue;
        std::size_t triangles = 0;
        for (const Primitive& primitive : scene.meshes[std::size_t(node.mesh)].primitives)
            if (primitive.topology == Topology::Triangles) triangles += primitive.indices.size() / 3;
        for (std::size_t i = 0; i < std::max<std::size_t>(node.instances.size(), 1); ++i, triangle += triangles)
            placed.push_back({n, i, triangle, triangles});
    }
    return placed;
}

Bounds bounds(const WorldMesh& mesh) {
    Bounds box;
    for (const Vec3& position : mesh.positions) box.add(position);
    return box;
}

}  // namespace daylit
