// Small closed worlds, each for one property of light that can be derived or seen at a glance.
#include <string>
#include <vector>

#include "content/blocks.h"
#include "content/levels.h"

namespace daylit::content {
namespace {

Level empty_level(const std::string& name) {
    Level level;
    level.name = name;
    level.day = Day{};
    return level;
}

// specular 0: the dielectric coat takes nothing, so that the albedo is exactly the base colour.
int add_matt(Level& level, const std::string& name, const Rgb& albedo, const Rgb& emission = Rgb(0.0f)) {
    Surface s;
    s.name = name;
    s.color = albedo;
    s.specular = 0.0f;
    s.emission = emission;
    return level.add_surface(s);
}

int one_finish(Blocks& blocks, int material) {
    return blocks.add_solid({material, material, material});
}

// Box with its faces looking inwards.
void add_inside_of_box(MeshBuilder& b, const Vec3& low, const Vec3& high) {
    const auto p = [&](int x, int y, int z) {
        return Vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
    };
    b.flat_quad(p(0, 0, 0), p(0, 0, 1), p(1, 0, 1), p(1, 0, 0));
    b.flat_quad(p(0, 1, 0), p(1, 1, 0), p(1, 1, 1), p(0, 1, 1));
    b.flat_quad(p(0, 0, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1));
    b.flat_quad(p(1, 0, 0), p(1, 0, 1), p(1, 1, 1), p(1, 1, 0));
    b.flat_quad(p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0));
    b.flat_quad(p(0, 0, 1), p(0, 1, 1), p(1, 1, 1), p(1, 0, 1));
}

}  // namespace

Level furnace() {
    Level level = empty_level("furnace");
    MeshBuilder b;
    b.material(add_matt(level, "glowing wall", Rgb(0.5f), Rgb(50.0f)));
    add_inside_of_box(b, {-2, 0, -2.5f}, {2, 3, 2.5f});
    level.add_object(b.take("room"));
    level.add_camera("view", {0, 1.5f, 2}, {0, 1.4f, -2}, 60);
    return level;
}

// Cornell University Program of Computer Graphics, the measured box, millimetres: x to the left seen from the camera,
// z into the box. The light's sheet is lowered by 0.5 mm off the ceiling; RGB stand-ins as commonly circulated.
Level cornell_box() {
    Level level = empty_level("cornell_box");
    const int white = add_matt(level, "white", {0.725f, 0.71f, 0.68f}),
              red = add_matt(level, "red", {0.63f, 0.065f, 0.05f});
    const int green = add_matt(level, "green", {0.14f, 0.45f, 0.091f});
    const int light = add_matt(level, "light", Rgb(0.78f), {17, 12, 4});
    struct Quad {
        int material;
        float mm[12];
    };
    const Quad quads[] = {
        {white, {552.8f, 0, 0, 0, 0, 0, 0, 0, 559.2f, 549.6f, 0, 559.2f}},
        {light, {343, 548.3f, 227, 343, 548.3f, 332, 213, 548.3f, 332, 213, 548.3f, 227}},
        {white, {556, 548.8f, 0, 556, 548.8f, 559.2f, 0, 548.8f, 559.2f, 0, 548.8f, 0}},
        {white, {549.6f, 0, 559.2f, 0, 0, 559.2f, 0, 548.8f, 559.2f, 556, 548.8f, 559.2f}},
        {green, {0, 0, 559.2f, 0, 0, 0, 0, 548.8f, 0, 0, 548.8f, 559.2f}},
        {red, {552.8f, 0, 0, 549.6f, 0, 559.2f, 556, 548.8f, 559.2f, 556, 548.8f, 0}},
        {white, {130, 165, 65, 82, 165, 225, 240, 165, 272, 290, 165, 114}},
        {white, {290, 0, 114, 290, 165, 114, 240, 165, 272, 240, 0, 272}},
        {white, {130, 0, 65, 130, 165, 65, 290, 165, 114, 290, 0, 114}},
        {white, {82, 0, 225, 82, 165, 225, 130, 165, 65, 130, 0, 65}},
        {white, {240, 0, 272, 240, 165, 272, 82, 165, 225, 82, 0, 225}},
        {white, {423, 330, 247, 265, 330, 296, 314, 330, 456, 472, 330, 406}},
        {white, {423, 0, 247, 423, 330, 247, 472, 330, 406, 472, 0, 406}},
        {white, {472, 0, 406, 472, 330, 406, 314, 330, 456, 314, 0, 456}},
        {white, {314, 0, 456, 314, 330, 456, 265, 330, 296, 265, 0, 296}},
        {white, {265, 0, 296, 265, 330, 296, 423, 330, 247, 423, 0, 247}},
    };
    MeshBuilder b;
    for (const Quad& q : quads) {
        b.material(q.material);
        Vec3 p[4];
        for (int i = 0; i < 4; ++i)
            p[i] = 1e-3f * Vec3(278.0f - q.mm[3 * i], q.mm[3 * i + 1], 279.6f - q.mm[3 * i + 2]);
        b.flat_quad(p[0], p[1], p[2], p[3]);
    }
    level.add_object(b.take("cornell box"));
    // Measured camera: (278, 273, -800) mm, focal length 35 mm for a film of 25 mm.
    level.add_camera("view", {0, 0.273f, 1.0796f}, {0, 0.273f, 0}, 39.3077);
    return level;
}

Level two_rooms() {
    Level level = empty_level("two_rooms");
    Blocks blocks;
    const int wall = one_finish(blocks, add_matt(level, "wall", Rgb(0.7f)));
    blocks.fill({-4.3f, -0.2f, -2.2f}, {4.3f, 3.0f, 2.2f}, wall);
    blocks.carve({-4.1f, 0, -2}, {-0.1f, 2.8f, 2}, 0);
    blocks.carve({0.1f, 0, -2}, {4.1f, 2.8f, 2}, 0);
    blocks.carve({-3.4f, 0.8f, 2}, {-0.8f, 2.4f, 2.2f}, 0);  // the window, south
    level.add_object(blocks.faces("two rooms", 0));
    level.add_camera("view", {-3.8f, 1.6f, -1.7f}, {-0.1f, 1.0f, 1.2f}, 65);
    level.add_camera("dark", {3.8f, 1.6f, 1.7f}, {0.1f, 1.2f, -1.2f}, 65);
    return level;
}

Level thin_wall() {
    Level level = empty_level("thin_wall");
    Blocks blocks;
    const int wall = one_finish(blocks, add_matt(level, "wall", Rgb(0.7f)));
    blocks.fill({-3.2f, -0.2f, -2.2f}, {3.2f, 2.8f, 2.2f}, wall);
    blocks.carve({-3, 0, -2}, {-0.01f, 2.6f, 2}, 0);
    blocks.carve({0.01f, 0, -2}, {3, 2.6f, 2}, 0);
    level.add_object(blocks.faces("rooms", 0));
    level.add_lamp({"lamp", Rgb(200.0f)}, {-1.2f, 1.6f, 0});
    level.add_camera("view", {-2.7f, 1.5f, 1.7f}, {0, 1.0f, -0.8f}, 65);
    level.add_camera("dark", {2.7f, 1.5f, 1.7f}, {0, 1.0f, -0.8f}, 65);
    return level;
}

Level sealed_room() {
    Level level = empty_level("sealed_room");
    Blocks blocks;
    const int wall = one_finish(blocks, add_matt(level, "wall", Rgb(0.7f)));
    blocks.fill({-2.2f, -0.2f, -2.2f}, {2.2f, 2.8f, 2.2f}, wall);
    blocks.carve({-2, 0, -2}, {2, 2.6f, 2}, 0);
    level.add_object(blocks.faces("room", 0));
    level.add_camera("view", {1.7f, 1.5f, 1.7f}, {-1, 1.0f, -1}, 65);
    return level;
}

Level maze() {
    Level level = empty_level("maze");
    Blocks blocks;
    const int wall = one_finish(blocks, add_matt(level, "wall", Rgb(0.7f)));
    // Corridors of 1.4 m; '#' is wall. The mouth is at the south; the far end is the north-west cell.
    const std::vector<std::string> plan = {"#######", "#.....#", "#.###.#", "#####.#", "#.....#",
                                           "#.#####", "#.....#", "#####.#", "#####.#"};
    const float pitch = 1.4f;
    blocks.fill({0, -0.2f, 0}, {7 * pitch, 2.7f, 9 * pitch}, wall);
    for (std::size_t row = 0; row < plan.size(); ++row)
        for (std::size_t column = 0; column < plan[row].size(); ++column)
            if (plan[row][column] == '.')
                blocks.carve({float(column) * pitch, 0, float(row) * pitch},
                             {float(column + 1) * pitch, 2.5f, float(row + 1) * pitch}, 0);
    level.add_object(blocks.faces("maze", 0));
    level.add_camera("view", {2.1f, 1.5f, 5.9f}, {7.5f, 1.2f, 6.4f}, 65);
    level.add_camera("mouth", {7.7f, 1.5f, 12.2f}, {7.6f, 1.2f, 8}, 65);
    level.add_camera("end", {2.1f, 1.5f, 3.6f}, {2.2f, 1.1f, 1.6f}, 65);
    return level;
}

Level tunnel() {
    Level level = empty_level("tunnel");
    Blocks blocks;
    const int wall = one_finish(blocks, add_matt(level, "wall", Rgb(0.6f)));
    blocks.fill({-1.7f, -0.2f, -30.2f}, {1.7f, 3.2f, 0}, wall);
    blocks.carve({-1.5f, 0, -30}, {1.5f, 3, 0}, 0);
    level.add_object(blocks.faces("tunnel", 0));
    level.add_camera("view", {0.4f, 1.65f, -28}, {0, 1.4f, 0}, 60);
    level.add_camera("mouth", {0, 1.65f, 6}, {0, 1.5f, 0}, 50);
    return level;
}

Level glossy_floor() {
    Level level = empty_level("glossy_floor");
    const int wall = add_matt(level, "wall", {0.5f, 0.48f, 0.45f});
    Blocks blocks;
    const int solid = one_finish(blocks, wall);
    blocks.fill({-4.2f, -0.4f, -4.2f}, {4.2f, 3.2f, 4.2f}, solid);
    blocks.carve({-4, -0.2f, -4}, {4, 3, 4}, 0);
    level.add_object(blocks.faces("room", 0));
    MeshBuilder b;
    // Exponents 2 / roughness^4 - 2: about 15, 80, 500 and 4800.
    const float roughness[4] = {0.585f, 0.395f, 0.252f, 0.1428f};
    for (int i = 0; i < 4; ++i) {
        Surface s;
        s.name = "glossy " + std::to_string(i + 1);
        s.color = {0.55f, 0.52f, 0.5f};
        s.metallic = 0.6f;
        s.roughness = roughness[i];
        b.material(level.add_surface(s));
        const float x = -4.0f + 2.0f * float(i);
        b.box({x + 0.01f, -0.19f, -3.99f}, {x + 1.99f, 0, 3.99f});
    }
    level.add_object(b.take("floor"));
    const Rgb glow[4] = {{900, 380, 160}, {300, 620, 800}, {700, 680, 620}, {240, 760, 260}};
    for (int i = 0; i < 4; ++i) {
        b.material(add_matt(level, "glow " + std::to_string(i + 1), Rgb(0.3f), glow[i]));
        const float x = -3.0f + 2.0f * float(i), h = 0.5f + 0.25f * float(i % 2);
        b.box({x - 0.2f, 0.3f, -2.2f}, {x + 0.2f, 0.3f + h, -1.8f});
    }
    level.add_object(b.take("glowing blocks"));
    level.add_lamp({"lamp left", {90, 80, 65}}, {-2, 2.4f, 0});
    level.add_lamp({"lamp right", {65, 80, 90}}, {2, 2.4f, 0.5f});
    level.add_camera("view", {0, 1.65f, 3.7f}, {0, 0.2f, -1.6f}, 65);
    return level;
}

Level caustic() {
    Level level = empty_level("caustic");
    MeshBuilder b;
    b.material(add_matt(level, "floor", {0.6f, 0.58f, 0.55f}));
    b.box({-3, -0.2f, -3}, {3, 0, 3});
    level.add_object(b.take("floor"));
    Surface glass;
    glass.name = "glass";
    glass.roughness = 0.0f;
    glass.transmission = 1.0f;
    b.material(level.add_surface(glass));
    b.sphere({0, 0.55f, 0}, 0.5f, 96);
    level.add_object(b.take("sphere"));
    level.add_camera("view", {1.9f, 1.5f, 1.6f}, {0, 0.25f, -0.25f}, 50);
    return level;
}

}  // namespace daylit::content
