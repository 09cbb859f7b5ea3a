// Ground, walls, roofs, openings: everything that light must not leak through.
#include <algorithm>
#include <array>
#include <cmath>

#include "content/castle.h"

namespace daylit::content {
namespace {

// Gable roof with its ridge along x (or z): two tiled slopes over [low, high] in plan, eaves `overhang` out on the long
// sides, ends plain (they run into gables or other roofs). A closed skin of 0.2 m but for the dark underside.
struct Roof {
    Vec2 low, high;  // x, z of the walls' outer faces
    float eaves, rise;
    bool along_x = true;
    bool end_low = false, end_high = false;  // close the triangular end with the wall material
};

void add_roof(MeshBuilder& b, const Palette& use, const Roof& r) {
    const float overhang = 0.35f, thick = 0.2f;
    // A closed end stands a little in front of the wall below it.
    const float proud = 0.08f;
    const float u0 = (r.along_x ? r.low.x : r.low.y) - (r.end_low ? proud : 0.0f);
    const float u1 = (r.along_x ? r.high.x : r.high.y) + (r.end_high ? proud : 0.0f);
    const float v0 = r.along_x ? r.low.y : r.low.x, v1 = r.along_x ? r.high.y : r.high.x;
    const float middle = 0.5f * (v0 + v1), half = 0.5f * (v1 - v0);
    const float slope = r.rise / half, drop = overhang * slope;
    const auto p = [&](float u, float y, float v) { return r.along_x ? Vec3(u, y, v) : Vec3(v, y, u); };
    const auto quad = [&](Vec3 a, Vec3 q, Vec3 c, Vec3 d, bool flip) {
        if (flip != r.along_x)
            b.flat_quad(a, q, c, d);
        else
            b.flat_quad(d, c, q, a);
    };
    for (int side : {-1, 1}) {
        const float edge = middle + float(side) * (half + overhang), wall = middle + float(side) * (half - 0.05f);
        const float y = r.eaves - drop + thick, ridge = r.eaves + r.rise + thick;
        const bool flip = side > 0;
        // Tiles run down the slope: u along the eaves, v down the fall.
        const Vec3 a = p(u0, y, edge), q = p(u1, y, edge), c = p(u1, ridge, middle), d = p(u0, ridge, middle);
        const float fall = glm::length(d - a);
        b.material(use.roof);
        if (flip == r.along_x)
            b.picture_quad(a, q, c, d, {u1 - u0, fall});
        else
            b.picture_quad(q, a, d, c, {u1 - u0, fall});
        b.material(use.oak);
        quad(p(u0, y - thick, edge), p(u1, y - thick, edge), q, a, !flip);
        quad(p(u0, y - thick, wall), p(u1, y - thick, wall), p(u1, y - thick, edge), p(u0, y - thick, edge), !flip);
    }
    // Ridge tiles and bargeboards.
    b.material(use.roof);
    b.tube(std::array{p(u0 - 0.02f, r.eaves + r.rise + thick, middle), p(u1 + 0.02f, r.eaves + r.rise + thick, middle)},
           0.13f, 8);
    b.material(use.brick);
    for (int end : {0, 1}) {
        if (!(end ? r.end_high : r.end_low)) continue;
        const float u = end ? u1 : u0, in = end ? u1 - proud - 0.02f : u0 + proud + 0.02f;
        const float y = r.eaves - drop + thick, a = v0 - overhang, z = v1 + overhang;
        std::vector<Vec3> gable = {p(u, y - thick, a), p(u, y - thick, z), p(u, y, z),
                                   p(u, r.eaves + r.rise + thick, middle), p(u, y, a)};
        if ((end == 1) == r.along_x) std::reverse(gable.begin(), gable.end());
        b.flat_polygon(gable);
        quad(p(in, y - thick, a), p(u, y - thick, a), p(u, y - thick, z), p(in, y - thick, z), end == 1);
    }
}

// Stepped gable across z at [x0, x1], in the old Danish manner.
void fill_stepped_gable(Castle& c, float x0, float x1, float z0, float z1, float y, float rise) {
    const float middle = 0.5f * (z0 + z1), half = 0.5f * (z1 - z0);
    const int steps = 7;
    for (int i = 0; i < steps; ++i) {
        const float w = half * (1.0f - float(i) / steps) + 0.15f;
        c.blocks.fill({x0, y + rise * float(i) / steps, middle - w},
                      {x1, y + rise * float(i + 1) / steps + 0.55f, middle + w}, c.walls);
    }
}

// A window that only shows: a niche with dark glass and lattice, in a wall with nothing behind it.
void add_blind_window(Castle& c, MeshBuilder& b, const Vec3& foot, Facing facing, Head head, float width,
                      float spring) {
    Opening o{.origin = foot,
              .facing = facing,
              .thickness = 0.35f,
              .loops = {{0.0f, outline(head, width, 0, spring)}, {0.35f, outline(head, width - 0.16f, 0.06f, spring)}},
              .room = c.open_air,
              .outer_wall = c.use.brick,
              .inner_wall = c.use.brick,
              .reveal = c.use.ashlar,
              .sill = c.use.ashlar};
    add_opening(c.blocks, b, o);
    add_surround(b, o, false, 0.16f, 0.05f, c.use.ashlar);
    add_tracery(b, o, o.loops.back(), Head::Flat, spring + head_height(head, width - 0.16f),
                {.depth = 0.3f,
                 .lights = width > 1.0f ? 2 : 1,
                 .transoms = 2,
                 .bar = 0.035f,
                 .sides = 4,
                 .bar_material = c.use.ashlar});
    b.at(wall_frame(o)).material(c.use.dark_glass);
    std::vector<Vec3> pane;
    for (const Vec2& p : o.loops.back().points) pane.emplace_back(p, -0.35f);
    b.flat_polygon(pane);
    b.at(wall_frame(o)).material(c.use.ashlar);
    b.bevel_box({-0.5f * width - 0.2f, -0.12f, -0.04f}, {0.5f * width + 0.2f, 0.0f, 0.12f}, 0.02f);
    b.at(Mat4(1.0f));
}

// A shut oak door in a shallow niche.
void add_blind_door(Castle& c, MeshBuilder& b, const Vec3& foot, Facing facing, int wall) {
    const float width = 1.3f, spring = 1.9f, depth = 0.22f;
    const std::vector<Vec2> shape = outline(Head::Round, width, 0, spring);
    Opening o{.origin = foot,
              .facing = facing,
              .thickness = depth,
              .loops = {{0.0f, shape}, {depth, shape}},
              .room = c.open_air,
              .outer_wall = wall,
              .inner_wall = wall,
              .reveal = c.use.ashlar,
              .sill = c.use.ashlar};
    add_opening(c.blocks, b, o);
    add_surround(b, o, false, 0.2f, 0.06f, c.use.ashlar);
    b.at(wall_frame(o)).material(c.use.oak);
    std::vector<std::uint32_t> v;
    for (const Vec2& p : shape) v.push_back(b.vertex({p.x, p.y, -depth}, {0, 0, 1}, {p.y, p.x}));
    for (std::size_t i = 1; i + 1 < v.size(); ++i) b.triangle(v[0], v[i], v[i + 1]);
    b.material(c.use.dark_oak);
    for (int i = 1; i < 5; ++i) {
        const float x = width * (float(i) / 5.0f - 0.5f);
        b.bevel_box({x - 0.02f, 0.02f, -depth - 0.01f}, {x + 0.02f, spring + 0.35f, -depth + 0.02f}, 0.006f,
                    Mapping::Grain);
    }
    b.material(c.use.iron);
    for (float y : {0.4f, 1.7f})
        b.bevel_box({-0.5f * width, y - 0.035f, -depth - 0.01f}, {0.42f * width, y + 0.035f, -depth + 0.03f}, 0.006f);
    b.sphere({0.4f * width, 1.05f, -depth + 0.05f}, 0.035f, 10);
    b.at(Mat4(1.0f));
}

// A door opening with an ashlar frame on both sides; the floor of the opening is its bottom.
Opening cut_door(Castle& c, MeshBuilder& b, const Vec3& foot, Facing facing, float thickness, float width, float spring,
                 Head head, int room, int outer, int inner, int floor) {
    Opening o{.origin = foot,
              .facing = facing,
              .thickness = thickness,
              .loops = {{0.0f, outline(head, width, 0, spring)}, {thickness, outline(head, width, 0, spring)}},
              .room = room,
              .outer_wall = outer,
              .inner_wall = inner,
              .reveal = c.use.ashlar,
              .sill = floor};
    add_opening(c.blocks, b, o);
    add_surround(b, o, false, 0.26f, 0.07f, c.use.ashlar);
    add_surround(b, o, true, 0.2f, 0.05f, c.use.ashlar);
    return o;
}

void add_hall_window(Castle& c, const Vec3& foot, Facing facing, float width) {
    const float spring = 5.0f, wide = width + 0.9f;
    Opening o{.origin = foot,
              .facing = facing,
              .thickness = 1.2f,
              .loops = {{0.0f, outline(Head::Pointed, width + 0.25f, 0.0f, spring)},
                        {0.3f, outline(Head::Pointed, width, 0.08f, spring)},
                        {0.5f, outline(Head::Pointed, width, 0.08f, spring)},
                        {1.2f, outline(Head::Pointed, wide, -0.35f, spring - 0.4f)}},
              .room = c.hall,
              .outer_wall = c.use.brick,
              .inner_wall = c.use.plaster,
              .reveal = c.use.ashlar,
              .sill = c.use.ashlar};
    MeshBuilder& b = c.hall_trim;
    add_opening(c.blocks, b, o);
    add_surround(b, o, false, 0.22f, 0.07f, c.use.ashlar);
    add_surround(b, o, true, 0.16f, 0.05f, c.use.ashlar);
    add_tracery(b, o, o.loops[1], Head::Pointed, spring,
                {.depth = 0.4f,
                 .lights = 2,
                 .transoms = 3,
                 .bar = 0.06f,
                 .bar_material = c.use.ashlar,
                 .sheet_material = c.use.lattice,
                 .sheet_thickness = 0.004f});
    b.at(wall_frame(o)).material(c.use.ashlar);
    b.bevel_box({-0.5f * width - 0.35f, -0.16f, -0.05f}, {0.5f * width + 0.35f, -0.005f, 0.16f}, 0.03f);
    b.bevel_box({-0.5f * wide - 0.2f, -0.5f, -1.28f}, {0.5f * wide + 0.2f, -0.355f, -1.1f}, 0.03f);
    b.at(Mat4(1.0f));
}

}  // namespace

void build_grounds(Castle& c) {
    Blocks& g = c.blocks;
    g.fill({-62, -7, -62}, {62, 0, 62}, c.earth);
    // The moat, a ring 11 m wide whose floor is the water (nobody sees its bed), with a bank beyond it that ends the
    // view.
    const auto ring = [&](float inner, float outer, float low, float high, const auto& put) {
        put({-outer, low, -outer}, {outer, high, -inner});
        put({-outer, low, inner}, {outer, high, outer});
        put({-outer, low, -inner}, {-inner, high, inner});
        put({inner, low, -inner}, {outer, high, inner});
    };
    const auto of = [&](int solid) {
        return [&g, solid](const Vec3& low, const Vec3& high) { g.fill(low, high, solid); };
    };
    ring(41, 52, -1.3f, 0.0f, [&](const Vec3& low, const Vec3& high) { g.carve(low, high, c.moat); });
    ring(57, 62, 0.0f, 1.6f, of(c.earth));
    ring(59.5f, 62, 1.6f, 3.2f, of(c.earth));
    // Curtain wall on the inner edge, with a coping.
    ring(38.0f, 39.2f, 0.0f, 2.6f, of(c.earth));
    ring(37.9f, 39.3f, 2.6f, 2.8f, of(c.stone));
}

void build_courtyard(Castle& c) {
    Blocks& g = c.blocks;
    g.fill({-28, -0.3f, -24}, {27.4f, 0, 27.2f}, c.gravel);  // around the castle
    g.fill({-40, -0.3f, -6.2f}, {-28, 0, -2.8f}, c.gravel);  // the way to the gate
    g.fill({-14, -0.3f, -14}, {14, 0, 11}, c.paving);
    g.fill({-14, 0, -15.2f}, {24.4f, 8.4f, -10}, c.walls);  // north wing
    g.fill({-21, 0, -10}, {-14, 7.4f, 11}, c.walls);        // west wing
    g.fill({14, 0, -10}, {24.4f, 7.4f, 11}, c.walls);       // east wing
    g.fill({-25, 0, -21}, {-14, 26, -10}, c.walls);         // the giant's tower
    // A string course all round, at the height of the upper floor.
    for (const auto& [low, high] : {std::pair{Vec2(-14, -10), Vec2(14, -9.88f)},
                                    {Vec2(-14.0f, -9.88f), Vec2(-13.88f, 11)},
                                    {Vec2(13.88f, -9.88f), Vec2(14, 11)}})
        g.fill({low.x, 4.75f, low.y}, {high.x, 4.95f, high.y}, c.stone);
    // Tower: string courses, cornice, parapet with merlons.
    for (float y : {9.2f, 16.6f}) g.fill({-25.15f, y, -21.15f}, {-13.85f, y + 0.35f, -9.85f}, c.stone);
    g.fill({-25.3f, 24.6f, -21.3f}, {-13.7f, 26, -9.7f}, c.walls);
    g.fill({-25.45f, 24.9f, -21.45f}, {-13.55f, 25.3f, -9.55f}, c.stone);
    g.carve({-24.7f, 25.6f, -20.7f}, {-14.3f, 26, -10.3f}, c.open_air);
    for (int i = 0; i < 6; ++i) {
        const float s = -25.3f + 2.08f * float(i);
        for (float z : {-21.3f, -10.3f}) g.fill({s, 26, z}, {s + 1.2f, 27.1f, z + 0.6f}, c.walls);
        const float t = -21.3f + 2.08f * float(i);
        if (i == 0 || i == 5) continue;
        for (float x : {-25.3f, -14.3f}) g.fill({x, 26, t}, {x + 0.6f, 27.1f, t + 1.2f}, c.walls);
    }

    MeshBuilder& b = c.court_trim;
    // Arcade: an aisle of 3.4 m behind columns; above the springing an arch over every bay.
    g.carve({-14, 0, -14}, {14, 4.5f, -10.6f}, c.arcade);
    g.carve({-14, 0, -10.6f}, {14, 2.4f, -10}, c.arcade);
    for (int bay = 0; bay < 7; ++bay) {
        const float x = -12.0f + 4.0f * float(bay);
        const std::vector<Vec2> arch = outline(Head::Round, 3.4f, 0, 0.2f);
        Opening o{.origin = {x, 2.4f, -10},
                  .facing = Facing::South,
                  .thickness = 0.6f,
                  .loops = {{0.0f, arch}, {0.6f, arch}},
                  .room = c.arcade,
                  .outer_wall = c.use.brick,
                  .inner_wall = c.use.plaster,
                  .reveal = c.use.ashlar,
                  .sill = c.use.ashlar,
                  .open_bottom = true};
        add_opening(g, b, o);
        add_surround(b, o, false, 0.24f, 0.06f, c.use.ashlar);
    }
    for (float x : {-8.0f, 0.0f, 8.0f}) add_blind_door(c, b, {x, 0, -14}, Facing::South, c.use.plaster);
    for (int i = 0; i <= 7; ++i) {
        const float x = std::clamp(-14.0f + 4.0f * float(i), -13.85f, 13.85f);
        add_column(b, c.use.ashlar, {x, 0, -10.3f}, 0.24f, 2.4f);
    }
    // The gate through the west wing, and windows on the upper floor.
    cut_door(c, b, {-14, 0, -4.5f}, Facing::East, 7.0f, 3.0f, 2.2f, Head::Round, c.gate, c.use.brick, c.use.brick,
             c.use.cobbles);
    for (int i = 0; i < 7; ++i) {
        const float x = -12.0f + 4.0f * float(i);
        add_blind_window(c, b, {x, 5.5f, -10}, Facing::South, Head::Segmental, 1.2f, 1.5f);
    }
    for (float z : {-7.5f, -1.2f, 2.6f, 6.4f}) {
        add_blind_window(c, b, {14, 5.3f, z}, Facing::West, Head::Segmental, 1.1f, 1.2f);
        add_blind_window(c, b, {-14, 5.3f, z}, Facing::East, Head::Segmental, 1.1f, 1.2f);
    }
    for (float y : {10.8f, 18.2f})
        for (float t : {-17.9f, -13.1f}) {
            add_blind_window(c, b, {-14, y, t}, Facing::East, Head::Round, 1.3f, 2.2f);
            add_blind_window(c, b, {t - 1.6f - (t < -15 ? 4.0f : 3.9f), y, -10}, Facing::South, Head::Round, 1.3f,
                             2.2f);
            add_blind_window(c, b, {-25, y, t}, Facing::West, Head::Round, 1.3f, 2.2f);
        }

    // Roofs. Attics are closed and dark: their floors and the insides of gables are not drawn.
    fill_stepped_gable(c, 14.4f, 15.2f, 11, 24.2f, 10.2f, 6.4f);
    fill_stepped_gable(c, -15.2f, -14.4f, 11, 24.2f, 10.2f, 6.4f);
    MeshBuilder roofs;
    add_roof(roofs, c.use, {.low = {-14.5f, 11}, .high = {14.5f, 24.2f}, .eaves = 10.2f, .rise = 6.4f});
    add_roof(roofs, c.use,
             {.low = {-14.2f, -15.2f}, .high = {24.4f, -10}, .eaves = 8.4f, .rise = 3.4f, .end_high = true});
    add_roof(
        roofs, c.use,
        {.low = {-21, -10.2f}, .high = {-14, 11}, .eaves = 7.4f, .rise = 3.6f, .along_x = false, .end_high = true});
    add_roof(
        roofs, c.use,
        {.low = {14, -12.6f}, .high = {24.4f, 11}, .eaves = 7.4f, .rise = 4.4f, .along_x = false, .end_high = true});
    c.level.add_object(roofs.take("roofs"));
}

void build_hall(Castle& c) {
    Blocks& g = c.blocks;
    MeshBuilder& b = c.hall_trim;
    g.fill({-15.2f, -0.6f, 11}, {15.2f, 10.2f, 24.2f}, c.walls);
    g.fill({-15.35f, -0.6f, 24.2f}, {15.35f, 0.8f, 24.35f}, c.stone);  // plinth
    g.carve({-14, kHallFloor, 12}, {14, kHallCeiling, 23}, c.hall);
    g.fill({10.2f, kHallFloor, 12}, {14, kHallFloor + 0.16f, 23}, c.stone);  // the dais, two steps
    g.fill({10.6f, kHallFloor + 0.16f, 12}, {14, kHallFloor + 0.32f, 23}, c.stone);
    // Chimney breast and hearth on the north wall.
    g.fill({-6.6f, kHallFloor, 12}, {-3.4f, kHallCeiling, 12.7f}, c.walls);
    g.carve({-5.9f, kHallFloor, 11.35f}, {-4.1f, kHallFloor + 1.7f, 12.7f}, c.hall);
    for (float x : {-10.4f, -5.2f, 0.0f, 5.2f, 10.4f}) add_hall_window(c, {x, 1.75f, 24.2f}, Facing::South, 1.9f);
    for (float z : {14.9f, 20.1f}) add_hall_window(c, {-15.2f, 1.75f, z}, Facing::West, 1.9f);
    // Two steps up from the courtyard, and the door.
    g.fill({4.7f, 0, 10.3f}, {7.7f, 0.15f, 11}, c.stone);
    cut_door(c, b, {6.2f, kHallFloor, 11}, Facing::North, 1.0f, 1.9f, 2.5f, Head::Segmental, c.hall, c.use.brick,
             c.use.plaster, c.use.ashlar);
}

void build_treasury(Castle& c) {
    Blocks& g = c.blocks;
    MeshBuilder& b = c.treasury_trim;
    g.carve({15.2f, kHallFloor, 1.0f}, {23.2f, 5.5f, 9.8f}, c.treasury);
    g.fill({13.3f, 0, 4.4f}, {14, 0.15f, 6.6f}, c.stone);
    cut_door(c, b, {14, kHallFloor, 5.5f}, Facing::West, 1.2f, 1.4f, 1.9f, Head::Round, c.treasury, c.use.brick,
             c.use.plaster, c.use.ashlar);
    // An oculus in the south wall whose shaft falls inwards, so that the noon sun reaches the floor.
    Opening oculus{.origin = {19.4f, 0, 11},
                   .facing = Facing::South,
                   .thickness = 1.2f,
                   .loops = {{0.0f, circle_outline(0.75f, 5.0f)}, {1.2f, circle_outline(1.15f, 3.7f)}},
                   .room = c.treasury,
                   .outer_wall = c.use.brick,
                   .inner_wall = c.use.plaster,
                   .reveal = c.use.ashlar,
                   .sill = c.use.ashlar};
    add_opening(g, b, oculus);
    back_inner_seam(b, oculus);
    add_surround(b, oculus, false, 0.2f, 0.06f, c.use.ashlar);
    b.at(wall_frame(oculus)).material(c.use.iron);
    for (float t : {-0.3f, 0.3f}) {
        b.tube(std::array{Vec3(t, 4.28f, -0.15f), Vec3(t, 5.72f, -0.15f)}, 0.018f, 6);
        b.tube(std::array{Vec3(-0.72f, 5.0f + t, -0.15f), Vec3(0.72f, 5.0f + t, -0.15f)}, 0.018f, 6);
    }
    b.at(Mat4(1.0f));
    // A slit to the east with tinted panes for the morning.
    Opening slit{
        .origin = {24.4f, 2.2f, 4.6f},
        .facing = Facing::East,
        .thickness = 1.2f,
        .loops = {{0.0f, outline(Head::Round, 0.5f, 0, 1.6f)}, {1.2f, outline(Head::Round, 1.3f, -0.5f, 1.4f)}},
        .room = c.treasury,
        .outer_wall = c.use.brick,
        .inner_wall = c.use.plaster,
        .reveal = c.use.ashlar,
        .sill = c.use.ashlar};
    add_opening(g, b, slit);
    back_inner_seam(b, slit);
    add_surround(b, slit, false, 0.16f, 0.05f, c.use.ashlar);
    add_tracery(b, slit, slit.loops[0], Head::Flat, 1.6f,
                {.depth = 0.1f,
                 .lights = 2,
                 .transoms = 4,
                 .bar = 0.015f,
                 .bar_material = c.use.iron,
                 .sheet_material = c.use.pane,
                 .sheet_thickness = 0.004f});
}

void build_cellar(Castle& c) {
    Blocks& g = c.blocks;
    // Corridors 1.6 m, walls 0.6 m; north on top. The stairs come down into the first open cell of the eighth row.
    const std::vector<std::string> plan = {"###################", "#...#.............#", "#.#.#.#####.#####.#",
                                           "#.#.#.#.#...#.....#", "#.#.#.#.#.###.#####", "#.#...#.#...#.....#",
                                           "#####.#.###.#####.#", "#...#.....#.#...#.#", "###.#.#####.#.#.#.#",
                                           "###.#.#...#.#.#.#.#", "###.###.#.#.#.#.#.#", "###.....#...#.#...#",
                                           "#############.#####", "###...............#", "###################"};
    const float corridor = 1.6f, wall = 0.6f, x0 = -14.6f, z0 = -8.2f;
    const auto line = [&](float start, std::size_t i) {
        return start + float(i / 2) * (corridor + wall) + (i % 2 ? wall : 0.0f);
    };
    for (std::size_t row = 0; row < plan.size(); ++row)
        for (std::size_t column = 0; column < plan[row].size(); ++column)
            if (plan[row][column] == '.')
                g.carve({line(x0, column), kCellarFloor, line(z0, row)},
                        {line(x0, column + 1), kCellarCeiling, line(z0, row + 1)}, c.cellar);
    // Nineteen risers of 0.18 m, treads 0.3 m, from the courtyard at z = 6 down to the north.
    const float rise = 0.18f, tread = 0.3f, top = 6.0f;
    for (int i = 0; i < 18; ++i) {
        const float z = top - tread * float(i), floor = -rise * float(i + 1);
        g.carve({-14, floor, z - tread}, {-12.4f, z - tread > 0.85f ? 0.0f : kCellarCeiling, z}, c.cellar);
    }
    // Parapet around the well of the stairs.
    g.fill({-12.4f, 0, 0.6f}, {-12.1f, 0.95f, 6.0f}, c.walls);
    g.fill({-14, 0, 0.6f}, {-12.4f, 0.95f, 0.9f}, c.walls);
    g.fill({-12.45f, 0.95f, 0.55f}, {-12.05f, 1.05f, 6.05f}, c.stone);
    g.fill({-14, 0.95f, 0.55f}, {-12.45f, 1.05f, 0.95f}, c.stone);
}

}  // namespace daylit::content
