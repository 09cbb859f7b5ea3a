#include "engine/render/geometry.h"

#include <cstddef>

#include "engine/gl/target.h"

namespace daylit {
namespace {

void attribute(GLuint array, GLuint index, int count, GLenum type, bool normalised, std::size_t offset,
               GLuint binding = 1) {
    glEnableVertexArrayAttrib(array, index);
    glVertexArrayAttribFormat(array, index, count, type, normalised, GLuint(offset));
    glVertexArrayAttribBinding(array, index, binding);
}

}  // namespace

Geometry::Geometry(DrawMesh mesh, bool moves)
    : mesh_(std::move(mesh)),
      positions_(make_buffer(mesh_.positions, moves ? GL_DYNAMIC_STORAGE_BIT : 0)),
      attributes_(make_buffer(mesh_.attributes, moves ? GL_DYNAMIC_STORAGE_BIT : 0)),
      indices_(make_buffer(mesh_.indices)),
      vertex_array_(make_vertex_array()) {
    const GLuint array = vertex_array_.get();
    glVertexArrayVertexBuffer(array, 0, positions_.get(), 0, sizeof(Vec3));
    glEnableVertexArrayAttrib(array, 0);
    glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, 0, 0);
    glVertexArrayVertexBuffer(array, 1, attributes_.get(), 0, sizeof(VertexAttributes));
    attribute(array, 1, 3, GL_SHORT, true, offsetof(VertexAttributes, normal));
    attribute(array, 2, 4, GL_INT_2_10_10_10_REV, true, offsetof(VertexAttributes, tangent));
    attribute(array, 3, 4, GL_FLOAT, false, offsetof(VertexAttributes, uvs));
    attribute(array, 4, 4, GL_HALF_FLOAT, false, offsetof(VertexAttributes, color));
    attribute(array, 5, 2, GL_UNSIGNED_SHORT, true, offsetof(VertexAttributes, lightmap_uv));
    glEnableVertexArrayAttrib(array, 6);
    glVertexArrayAttribIFormat(array, 6, 1, GL_UNSIGNED_SHORT, GLuint(offsetof(VertexAttributes, cluster)));
    glVertexArrayAttribBinding(array, 6, 1);
    glVertexArrayElementBuffer(array, indices_.get());
}

void Geometry::use_indices(GLuint buffer) const {
    glVertexArrayElementBuffer(vertex_array_.get(), buffer ? buffer : indices_.get());
}

void Geometry::use_light(GLuint buffer) const {
    const GLuint array = vertex_array_.get();
    glVertexArrayVertexBuffer(array, 2, buffer, 0, 2 * sizeof(Vec3));
    attribute(array, 7, 3, GL_FLOAT, false, 0, 2);
    attribute(array, 8, 3, GL_FLOAT, false, sizeof(Vec3), 2);
}

std::vector<Bounds> Geometry::move(const WorldMesh& moved) {
    const std::vector<Bounds> boxes = move_draw_mesh(mesh_, moved);
    glNamedBufferSubData(positions_.get(), 0, GLsizeiptr(mesh_.positions.size() * sizeof(Vec3)),
                         mesh_.positions.data());
    glNamedBufferSubData(attributes_.get(), 0, GLsizeiptr(mesh_.attributes.size() * sizeof(VertexAttributes)),
                         mesh_.attributes.data());
    return boxes;
}

void DrawList::add(std::uint32_t first, std::uint32_t count) {
    if (count == 0) return;
    triangles += count / 3;
    if (first == end) {
        counts.back() += GLsizei(count);
    } else {
        counts.push_back(GLsizei(count));
        offsets.push_back(reinterpret_cast<const void*>(std::uintptr_t(first) * 4));
    }
    end = first + count;
}

void Geometry::add_visible(const Batch& batch, const Frustum& frustum, DrawList& list) const {
    for (std::uint32_t i = 0; i < batch.cluster_count; ++i) add_if_visible(batch.first_cluster + i, frustum, list);
}

void Geometry::add_if_visible(std::uint32_t number, const Frustum& frustum, DrawList& list) const {
    const Cluster& cluster = mesh_.clusters[number];
    if (!may_see(frustum, cluster.bounds)) {
        ++list.clusters_culled;
        return;
    }
    ++list.clusters_drawn;
    list.add(cluster.first, cluster.count);
}

void Geometry::draw(const DrawList& list) {
    if (list.empty()) return;
    glMultiDrawElements(GL_TRIANGLES, list.counts.data(), GL_UNSIGNED_INT, list.offsets.data(),
                        GLsizei(list.counts.size()));
}

}  // namespace daylit
