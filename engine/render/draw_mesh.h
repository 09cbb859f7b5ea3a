#pragma once
// World-space triangles in the order in which they are drawn: by material, then in clusters that are near each other.
#include <cstdint>
#include <vector>

#include "engine/baked/day_lightmap.h"
#include "engine/scene/pose.h"

namespace daylit {

/// Everything of a vertex but its position, which depth-only passes read alone. 40 bytes.
struct VertexAttributes {
    std::int16_t normal[3];        // signed, normalised
    std::uint16_t cluster;         // number of its cluster modulo 2^16
    std::uint32_t tangent;         // 10-10-10-2 signed, normalised; w is the handedness
    float uvs[4];                  // both sets
    std::uint16_t color[4];        // halves
    std::uint16_t lightmap_uv[2];  // normalised
};
static_assert(sizeof(VertexAttributes) == 40);

/// Neighbouring triangles of one material (and node, where asked); the unit of culling.
struct Cluster {
    Bounds bounds;
    std::uint32_t first = 0, count = 0;  // in DrawMesh::indices
    std::uint32_t node = 0;              // whose triangles, where the mesh was built by node
    std::uint64_t moves = 0;             // so far: times that a place or a normal of it changed
};

struct Batch {
    std::uint32_t material = 0;
    std::uint32_t first_cluster = 0, cluster_count = 0;
    bool vertex_colors = false;  // some vertex is not white
};

struct DrawMesh {
    std::vector<Vec3> positions;
    std::vector<VertexAttributes> attributes;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> source;  // each vertex' vertex in the WorldMesh
    std::vector<Cluster> clusters;      // of batch 0, then of batch 1, ...
    std::vector<Batch> batches;         // ascending materials
};

/// lightmap null: vertices keep (0, 0). by_node: no cluster holds triangles of two nodes, for meshes that move.
/// The same input gives the same output.
DrawMesh build_draw_mesh(const WorldMesh& mesh, const DayLightmap* lightmap, bool by_node);

/// Positions, normals, tangents and cluster bounds again after the same triangles moved.
/// returns   the boxes before and after of every cluster of which some vertex moved; empty: none did
std::vector<Bounds> move_draw_mesh(DrawMesh& mesh, const WorldMesh& moved);

}  // namespace daylit
