// The koldinghus level: order of building. Nothing here is measured from the real castle; ORIGINS.md says what it
// follows.
#include "content/castle.h"

#include <utility>

#include "content/levels.h"
#include "content/textures.h"

namespace daylit::content {
namespace {

Surface plain(const std::string& name, const Rgb& color, float roughness, float metallic = 0.0f) {
    Surface s;
    s.name = name;
    s.color = color;
    s.roughness = roughness;
    s.metallic = metallic;
    return s;
}

Surface glowing(const std::string& name, const Rgb& color, const Rgb& emission, Lit lit = Lit::Always) {
    Surface s = plain(name, color, 0.9f);
    s.emission = emission;
    s.lit = lit;
    return s;
}

int variant(Level& level, int of, const std::string& name, const Rgb& tint, float roughness) {
    Surface s = level.surfaces[std::size_t(of)];
    s.name = name;
    s.color = tint;
    s.roughness = roughness;
    return level.add_surface(s);
}

int clear(Level& level, const std::string& name, const Rgb& tint, float alpha) {
    Surface s = plain(name, tint, 0.4f);
    s.alpha = alpha;
    s.alpha_mode = AlphaMode::Blend;
    s.double_sided = true;
    return level.add_surface(s);
}

}  // namespace

Palette make_palette(Level& level) {
    const std::vector<int> made =
        add_patterns(level, {brick(),  ashlar(), rough_stone(), plaster(), oak(),   oak_floor(),    marble_floor(),
                             brass(),  iron(),   tapestry(),    banner(),  linen(), leaded_glass(), cobbles(),
                             gravel(), grass(),  roof_tiles(),  leaves(),  bark(),  books()});
    Palette p{};
    int* const slots[] = {&p.brick,  &p.ashlar, &p.field_stone, &p.plaster, &p.oak,  &p.boards,  &p.marble,
                          &p.brass,  &p.iron,   &p.tapestry,    &p.banner,  &p.wool, &p.lattice, &p.cobbles,
                          &p.gravel, &p.grass,  &p.roof,        &p.leaves,  &p.bark, &p.books};
    for (std::size_t i = 0; i < made.size(); ++i) *slots[i] = made[i];

    p.dark_oak = variant(level, p.oak, "dark oak", {0.62f, 0.56f, 0.5f}, 0.5f);
    p.polished_marble = variant(level, p.marble, "polished marble", Rgb(0.95f), 0.72f);
    p.red_wool = variant(level, p.wool, "red wool", {0.42f, 0.07f, 0.06f}, 1.0f);
    p.blue_wool = variant(level, p.wool, "blue wool", {0.09f, 0.14f, 0.3f}, 1.0f);
    p.flame = level.add_surface(glowing("flame", {0.6f, 0.5f, 0.4f}, Rgb(1.0f, 0.55f, 0.2f) * 9000.0f, Lit::Evening));
    p.oil_flame = level.add_surface(glowing("oil flame", {0.6f, 0.5f, 0.4f}, Rgb(1.0f, 0.55f, 0.2f) * 9000.0f));
    p.embers = level.add_surface(glowing("embers", {0.2f, 0.15f, 0.12f}, Rgb(1.0f, 0.3f, 0.07f) * 420.0f));
    p.bulb =
        level.add_surface(glowing("lamp flame", {0.6f, 0.5f, 0.4f}, Rgb(1.0f, 0.6f, 0.25f) * 9000.0f, Lit::Evening));
    Surface glass = plain("glass", Rgb(0.97f, 0.985f, 0.98f), 0.0f);
    glass.transmission = 1.0f;
    p.glass = level.add_surface(glass);
    p.pane = clear(level, "tinted pane", {0.45f, 0.62f, 0.5f}, 0.12f);  // either face of a pane
    level.surfaces[std::size_t(p.pane)].double_sided = false;
    p.gauze = clear(level, "gauze", {0.7f, 0.66f, 0.56f}, 0.45f);
    p.silver = level.add_surface(plain("pewter", {0.62f, 0.61f, 0.58f}, 0.36f, 1.0f));
    p.gold = level.add_surface(plain("gilding", {0.82f, 0.62f, 0.27f}, 0.34f, 1.0f));
    p.steel = level.add_surface(plain("steel", {0.5f, 0.5f, 0.52f}, 0.38f, 1.0f));
    p.wax = level.add_surface(plain("beeswax", {0.72f, 0.6f, 0.38f}, 0.5f));
    p.water = level.add_surface(plain("water", {0.05f, 0.07f, 0.06f}, 0.12f));
    p.earthenware = level.add_surface(plain("earthenware", {0.42f, 0.2f, 0.12f}, 0.55f));
    p.ash = level.add_surface(plain("ash", {0.12f, 0.11f, 0.1f}, 1.0f));
    p.skin = level.add_surface(plain("skin", {0.55f, 0.36f, 0.27f}, 0.6f));
    p.hair = level.add_surface(plain("hair", {0.16f, 0.09f, 0.05f}, 0.7f));
    p.leather = level.add_surface(plain("leather", {0.2f, 0.11f, 0.06f}, 0.6f));
    p.dark_glass = level.add_surface(plain("dark window", {0.03f, 0.035f, 0.045f}, 0.25f));
    p.bread = level.add_surface(plain("bread", {0.5f, 0.3f, 0.13f}, 0.9f));
    p.apple = level.add_surface(plain("apple", {0.5f, 0.12f, 0.06f}, 0.4f));
    p.wine_red = level.add_surface(plain("wine", {0.22f, 0.02f, 0.03f}, 0.2f));
    return p;
}

Level koldinghus() {
    Level level;
    level.name = "koldinghus";
    level.day = Day{};
    const Palette use = make_palette(level);
    Castle c{.level = level,
             .use = use,
             .blocks = {},
             .earth = 0,
             .paving = 0,
             .gravel = 0,
             .walls = 0,
             .stone = 0,
             .hall = 0,
             .treasury = 0,
             .cellar = 0,
             .arcade = 0,
             .gate = 0,
             .moat = 0,
             .hall_trim = {},
             .treasury_trim = {},
             .court_trim = {}};
    c.earth = c.blocks.add_solid({use.field_stone, use.grass, use.field_stone});
    c.paving = c.blocks.add_solid({use.field_stone, use.cobbles, use.field_stone});
    c.gravel = c.blocks.add_solid({use.field_stone, use.gravel, use.field_stone});
    c.walls = c.blocks.add_solid({use.brick, use.ashlar, use.brick});
    c.stone = c.blocks.add_solid({use.ashlar, use.ashlar, use.ashlar});
    c.hall = c.blocks.add_room({use.plaster, use.marble, use.boards});
    c.treasury = c.blocks.add_room({use.plaster, use.polished_marble, use.plaster});
    c.cellar = c.blocks.add_room({use.field_stone, use.field_stone, use.brick});
    c.arcade = c.blocks.add_room({use.plaster, use.cobbles, use.boards});
    c.gate = c.blocks.add_room({use.brick, use.cobbles, use.plaster});
    c.moat = c.blocks.add_room({-1, use.water, -1});

    build_grounds(c);
    build_courtyard(c);
    build_hall(c);
    build_treasury(c);
    build_cellar(c);
    const std::pair<const char*, int> shells[] = {{"castle and grounds", c.open_air},
                                                  {"hall walls", c.hall},
                                                  {"treasury walls", c.treasury},
                                                  {"cellar walls", c.cellar},
                                                  {"arcade walls", c.arcade},
                                                  {"gate walls", c.gate},
                                                  {"moat", c.moat}};
    for (const auto& [name, room] : shells)
        if (LevelMesh faces = c.blocks.faces(name, room); !faces.parts.empty()) level.add_object(std::move(faces));
    level.add_object(c.hall_trim.take("hall windows and mouldings"));
    level.add_object(c.treasury_trim.take("treasury windows and mouldings"));
    level.add_object(c.court_trim.take("courtyard windows and mouldings"));
    furnish_hall(c);
    furnish_treasury(c);
    furnish_cellar(c);
    furnish_courtyard(c);
    add_moving_things(c);
    add_cameras(c);
    return level;
}

void add_cameras(Castle& c) {
    Level& l = c.level;
    l.add_camera("hall", {-12.6f, 1.95f, 14.6f}, {4.0f, 3.0f, 18.6f}, 60);
    l.add_camera("hall_windows", {9.0f, 1.95f, 13.4f}, {-3.0f, 3.2f, 21.5f}, 62);
    l.add_camera("hall_evening", {10.0f, 2.1f, 19.6f}, {-9.0f, 3.4f, 15.4f}, 62);
    l.add_camera("treasury", {15.9f, 1.95f, 1.7f}, {20.3f, 1.6f, 7.4f}, 62);
    l.add_camera("brass", {19.1f, 1.75f, 5.4f}, {20.9f, 1.45f, 7.1f}, 55);
    l.add_camera("glass", {18.6f, 1.75f, 6.0f}, {17.45f, 1.4f, 7.45f}, 55);
    l.add_camera("courtyard", {9.6f, 1.65f, 8.8f}, {-6.5f, 5.2f, -9.0f}, 65);
    l.add_camera("arcade", {-12.6f, 1.65f, -11.3f}, {4.0f, 1.9f, -12.6f}, 60);
    l.add_camera("cellar_entrance", {-13.1f, 1.65f, 8.6f}, {-13.2f, -1.6f, 2.0f}, 62);
    l.add_camera("cellar_maze", {-6.2f, -1.77f, 4.45f}, {-11.4f, -2.0f, 4.1f}, 65);
    l.add_camera("door", {2.2f, 1.95f, 16.6f}, {6.2f, 1.7f, 11.6f}, 60);
    l.add_camera("cart", {-3.2f, 1.5f, 18.9f}, {-6.0f, 0.95f, 21.2f}, 55);
    l.add_camera("figure", {-0.4f, 1.65f, -4.9f}, {3.4f, 1.2f, -8.2f}, 55);
    l.add_camera("tower", {-15.3f, 26.6f, -9.5f}, {1.0f, 2.0f, 7.0f}, 60);
    l.add_camera("overview", {41.0f, 25.5f, 46.0f}, {-1.0f, 4.0f, 2.0f}, 50);
}

}  // namespace daylit::content
