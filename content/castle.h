#pragma once
// What the parts of the koldinghus level share: materials, the block grid, rooms, and measures in metres.
// East is +X, south is +Z. The courtyard's ground is y = 0.
#include "content/blocks.h"
#include "content/opening.h"

namespace daylit::content {

struct Palette {
    int brick, ashlar, field_stone, plaster, oak, boards, marble, brass, iron, tapestry, banner, wool;
    int lattice, cobbles, gravel, grass, roof, leaves, bark, books;
    int dark_oak, polished_marble, flame, oil_flame, embers, bulb, glass, pane, gauze, silver, wax, water, earthenware,
        ash;
    int red_wool, blue_wool, skin, hair, leather, steel, gold, dark_glass, bread, apple, wine_red;
};
Palette make_palette(Level& level);

struct Castle {
    Level& level;
    Palette use;
    Blocks blocks;
    int earth, paving, gravel, walls, stone;                       // solids
    int open_air = 0, hall, treasury, cellar, arcade, gate, moat;  // rooms
    MeshBuilder hall_trim, treasury_trim, court_trim;              // openings and mouldings, one mesh a room
};

inline constexpr float kHallFloor = 0.3f, kHallCeiling = 9.3f;
inline constexpr float kCellarFloor = -3.42f, kCellarCeiling = -0.92f;

// Each fills and carves its part of the grid, and adds its trim, furniture, lamps and cameras.
void build_grounds(Castle& castle);
void build_hall(Castle& castle);
void build_treasury(Castle& castle);
void build_cellar(Castle& castle);
void build_courtyard(Castle& castle);
void furnish_hall(Castle& castle);
void furnish_treasury(Castle& castle);
void furnish_cellar(Castle& castle);
void furnish_courtyard(Castle& castle);
void add_moving_things(Castle& castle);
void add_cameras(Castle& castle);

// Kits that several rooms use.
void add_candle(MeshBuilder& b, const Palette& use, int flame_material, const Vec3& foot, float height);
void add_barrel(MeshBuilder& b, const Palette& use, const Mat4& place);
void add_chest(MeshBuilder& b, const Palette& use, const Mat4& place);
void add_goblet(MeshBuilder& b, int material, const Vec3& foot, float height);
/// Base, shaft and capital; stands on `foot`, free or half sunk in a wall.
void add_column(MeshBuilder& b, int material, const Vec3& foot, float radius, float height);
/// A cloth with gentle folds on a pole, in front of a wall; its picture shown once.
void add_hanging(MeshBuilder& b, const Castle& castle, int cloth, const Vec3& top, Facing facing, const Vec2& size,
                 float fold);
void add_shield(MeshBuilder& b, const Palette& use, int field, const Vec3& centre, Facing facing);
void add_teapot(MeshBuilder& b, int material, const Mat4& place, int divisions);

}  // namespace daylit::content
