#pragma once
// A DrawMesh on the GPU, and drawing the part of it that a view can see.
#include "engine/gl/owners.h"
#include "engine/render/culling.h"
#include "engine/render/draw_mesh.h"

namespace daylit {

/// Index ranges to draw, neighbouring clusters joined.
struct DrawList {
    std::vector<GLsizei> counts;
    std::vector<const void*> offsets;
    int clusters_drawn = 0, clusters_culled = 0;
    long triangles = 0;
    std::uint32_t end = ~std::uint32_t(0);  // of the last range, in indices
    bool empty() const { return counts.empty(); }
    void add(std::uint32_t first, std::uint32_t count);
    void clear() { *this = {}; }
};

class Geometry {
  public:
    /// moves   the mesh will be changed by move()
    Geometry(DrawMesh mesh, bool moves);

    const DrawMesh& mesh() const { return mesh_; }
    /// The same triangles elsewhere; returns as move_draw_mesh().
    std::vector<Bounds> move(const WorldMesh& moved);

    /// Adds the batch's clusters that the frustum may see.
    void add_visible(const Batch& batch, const Frustum& frustum, DrawList& list) const;
    /// One of them; clusters are added in their order.
    void add_if_visible(std::uint32_t cluster, const Frustum& frustum, DrawList& list) const;
    void bind() const { glBindVertexArray(vertex_array_.get()); }
    /// Other indices over the same vertices, until the next call; 0: the mesh's own.
    void use_indices(GLuint buffer) const;
    /// Attributes 7 and 8 from now on: three floats each, a vertex' after the one before.
    void use_light(GLuint buffer) const;
    /// bind() first.
    static void draw(const DrawList& list);

  private:
    DrawMesh mesh_;
    GlBuffer positions_, attributes_, indices_;
    GlVertexArray vertex_array_;
};

}  // namespace daylit
