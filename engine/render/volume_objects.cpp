#include "engine/render/volume_objects.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/gl/target.h"

namespace daylit {
namespace {

double squared_edges(const DrawMesh& mesh, const Cluster& cluster) {
    double sum = 0.0;
    for (std::uint32_t i = cluster.first; i < cluster.first + cluster.count; i += 3)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Vec3 edge = mesh.positions[mesh.indices[i + (k + 1) % 3]] - mesh.positions[mesh.indices[i + k]];
            sum += double(glm::dot(edge, edge));
        }
    return sum;
}

/// As the shader has it.
Vec3 unit_normal(const VertexAttributes& vertex) {
    return glm::normalize(Vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]));
}

}  // namespace

void VolumeObjects::set_mesh(const DrawMesh& mesh, const std::vector<BatchLook>& looks) {
    things_.clear(), parts_.clear();
    std::map<std::uint32_t, std::uint32_t> thing_of_node;
    for (const Cluster& cluster : mesh.clusters) {
        const auto [at, is_new] = thing_of_node.try_emplace(cluster.node, std::uint32_t(things_.size()));
        if (is_new) things_.emplace_back();
        const auto begin = mesh.indices.begin() + long(cluster.first);
        const auto [least, greatest] = std::minmax_element(begin, begin + long(cluster.count));
        parts_.push_back({at->second, *least, *greatest + 1, cluster.moves, {}});
    }
    for (std::size_t b = 0; b < mesh.batches.size(); ++b)
        for (std::uint32_t c = 0; c < mesh.batches[b].cluster_count; ++c)
            parts_[mesh.batches[b].first_cluster + c].look = looks[b];
    measure(mesh);
    buffer_ = make_buffer(std::vector<TwoSided>(mesh.positions.size(), {Rgb(0.0f), Rgb(0.0f)}), GL_DYNAMIC_STORAGE_BIT);
}

void VolumeObjects::measure(const DrawMesh& mesh) {
    things_.assign(things_.size(), {});
    std::vector<double> squares(things_.size(), 0.0), edges(things_.size(), 0.0);
    for (std::size_t c = 0; c < parts_.size(); ++c) {
        const Cluster& cluster = mesh.clusters[c];
        const std::uint32_t thing = parts_[c].thing;
        things_[thing].box.add(cluster.bounds.min);
        things_[thing].box.add(cluster.bounds.max);
        squares[thing] += squared_edges(mesh, cluster);
        edges[thing] += double(cluster.count);
    }
    for (std::size_t i = 0; i < things_.size(); ++i) things_[i].edge = float(std::sqrt(squares[i] / edges[i]));
    modes_.clear();
}

void VolumeObjects::move(const DrawMesh& mesh) {
    std::vector<bool> moved(things_.size());
    for (std::size_t c = 0; c < parts_.size(); ++c) {
        if (parts_[c].moves == mesh.clusters[c].moves) continue;
        parts_[c].moves = mesh.clusters[c].moves;
        moved[parts_[c].thing] = true;
    }
    // All of a thing: where it is lit once, that place has moved with any part of it.
    for (Part& part : parts_)
        if (moved[part.thing]) part.lit = VolumeMode::Auto;
    measure(mesh);
}

VolumeMode VolumeObjects::mode(std::uint32_t cluster) const {
    const Part& part = parts_[cluster];
    if (part.look.through) return VolumeMode::Vertex;
    return part.look.metallic && asked_ == VolumeMode::Auto ? VolumeMode::Pixel : modes_[part.thing];
}

bool VolumeObjects::plan(const DrawMesh& mesh, const Frustum& frustum, const VolumeTree& tree, VolumeMode asked,
                         bool light_moved) {
    if (modes_.empty() || asked != asked_) {
        modes_.assign(things_.size(), asked);
        for (std::size_t i = 0; asked == VolumeMode::Auto && i < things_.size(); ++i)
            modes_[i] = volume_mode_of(things_[i], tree);
        asked_ = asked;
    }
    unlit_.clear();
    any_at_pixels_ = false;
    for (std::uint32_t c = 0; c < parts_.size(); ++c) {
        Part& part = parts_[c];
        if (light_moved) part.lit = VolumeMode::Auto;
        if (part.lit == mode(c) || !may_see(frustum, mesh.clusters[c].bounds)) continue;
        if (at_pixels(c))
            any_at_pixels_ = true;
        else
            unlit_.push_back(c);
    }
    return !unlit_.empty();
}

long VolumeObjects::renew(const DrawMesh& mesh, BakedVolume& volume) {
    long triangles = 0;
    std::vector<Vec3> normals;
    std::vector<TwoSided> light;
    for (const std::uint32_t c : unlit_) {
        Part& part = parts_[c];
        const std::span<const Vec3> places(mesh.positions.data() + part.first, part.end - part.first);
        normals.clear();
        for (std::uint32_t v = part.first; v < part.end; ++v) normals.push_back(unit_normal(mesh.attributes[v]));
        light.resize(places.size());
        part.lit = mode(c);
        if (part.lit == VolumeMode::Object) {
            const Bounds& box = things_[part.thing].box;
            const glsl::VolumeSh sh = volume.light().radiance(0.5f * (box.min + box.max));
            for (std::size_t i = 0; i < light.size(); ++i)
                light[i] = {glsl::volume_irradiance(sh, normals[i], 1.0f),
                            glsl::volume_irradiance(sh, normals[i], -1.0f)};
        } else {
            volume.batch().two_sided(places, normals, light);
        }
        glNamedBufferSubData(buffer_.get(), GLintptr(part.first * sizeof(TwoSided)),
                             GLsizeiptr(light.size() * sizeof(TwoSided)), light.data());
        triangles += mesh.clusters[c].count / 3;
    }
    unlit_.clear();
    return triangles;
}

}  // namespace daylit
