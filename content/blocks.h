#pragma once
// Walls, floors and rooms as boxes filled and carved in order on a rectilinear grid. What is left between solid and
// air becomes faces, merged into rectangles: watertight by construction, with true wall thickness, no coplanar
// doubles, and no T-junctions (every corner that lies on a neighbour's edge is a vertex of that neighbour too).
#include <array>
#include <cstdint>
#include <vector>

#include "content/mesh_builder.h"

namespace daylit::content {

/// Materials of the faces of a solid, or of what a room shows of the solids around it; -1 leaves it to the solid.
struct Finish {
    int wall = -1, floor = -1, ceiling = -1;
};

class Blocks {
  public:
    int add_solid(const Finish& finish);
    /// Room 0 exists from the start: the open air, which leaves every finish to the solids.
    int add_room(const Finish& finish);

    void fill(const Vec3& low, const Vec3& high, int solid);
    void carve(const Vec3& low, const Vec3& high, int room);
    /// Air whose borders with solids are not drawn, since an opening's own reveal stands in front of them.
    void cover(const Vec3& low, const Vec3& high, int room);

    /// The faces seen from one room. Everything outside all boxes is air of room 0.
    LevelMesh faces(const std::string& name, int room);
    bool solid_at(const Vec3& point);

  private:
    struct Operation {
        Vec3 low, high;
        int solid, room;
        bool covered;
    };
    struct Cell {
        std::int16_t solid = -1, room = 0;
        bool covered = false;
    };
    struct Rectangle {
        int axis, plane, a0, a1, b0, b1, material;
        bool positive;
    };
    void build();
    void merge_plane(int axis, int plane, bool positive);
    int seen_material(const Cell& solid, const Cell& air, int axis, bool positive) const;
    const Cell& cell(int x, int y, int z) const;
    Vec3 point(const std::array<int, 3>& index) const;
    void emit(MeshBuilder& builder, const Rectangle& rectangle) const;
    std::size_t corner_key(const std::array<int, 3>& index) const;

    std::vector<Finish> solids_, rooms_ = {Finish{}};
    std::vector<Operation> operations_;
    bool built_ = false;
    std::array<std::vector<float>, 3> lines_;
    std::vector<Cell> cells_;
    std::vector<std::vector<Rectangle>> rectangles_;  // by room
    std::vector<bool> corner_;
};

}  // namespace daylit::content
