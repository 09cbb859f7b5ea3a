#include "content/textures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "content/noise.h"
#include "content/png.h"
#include "engine/base/image.h"

namespace daylit::content {
namespace {

std::uint8_t byte(float v) {
    return std::uint8_t(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

std::vector<Texel> evaluate(const Pattern& p) {
    std::vector<Texel> texels(std::size_t(p.width) * std::size_t(p.height));
    tbb::parallel_for(0, p.height, [&](int y) {
        for (int x = 0; x < p.width; ++x)
            texels[std::size_t(y) * std::size_t(p.width) + std::size_t(x)] =
                p.texel({(float(x) + 0.5f) / float(p.width), (float(y) + 0.5f) / float(p.height)});
    });
    return texels;
}

std::vector<std::uint8_t> color_png(const Pattern& p, const std::vector<Texel>& texels) {
    const int channels = p.alpha_mode == AlphaMode::Opaque ? 3 : 4;
    static const std::vector<std::uint8_t> coded = [] {  // fine enough that no step at the dark end exceeds one code
        std::vector<std::uint8_t> table;
        for (int i = 0; i <= 16384; ++i) table.push_back(byte(encode_srgb(float(i) / 16384.0f)));
        return table;
    }();
    std::vector<std::uint8_t> pixels;
    pixels.reserve(texels.size() * std::size_t(channels));
    for (const Texel& t : texels) {
        for (int c = 0; c < 3; ++c)
            pixels.push_back(coded[std::size_t(std::clamp(t.color[c], 0.0f, 1.0f) * 16384.0f + 0.5f)]);
        if (channels == 4) pixels.push_back(byte(t.alpha));
    }
    return encode_png(p.width, p.height, channels, pixels);
}

// Slopes by central differences over the repeating tile; green points up the picture.
std::vector<std::uint8_t> normal_png(const Pattern& p, const std::vector<Texel>& texels) {
    const auto height = [&](int x, int y) {
        return texels[std::size_t(wrap(y, p.height)) * std::size_t(p.width) + std::size_t(wrap(x, p.width))].height;
    };
    const Vec2 step = 2.0f * p.tile / Vec2(p.width, p.height);
    std::vector<std::uint8_t> pixels;
    pixels.reserve(texels.size() * 3);
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const float dx = (height(x + 1, y) - height(x - 1, y)) / step.x;
            const float dy = (height(x, y - 1) - height(x, y + 1)) / step.y;
            const Vec3 n = glm::normalize(Vec3(-dx, -dy, 1.0f));
            for (int c = 0; c < 3; ++c) pixels.push_back(byte(n[c] * 0.5f + 0.5f));
        }
    return encode_png(p.width, p.height, 3, pixels);
}

std::vector<std::uint8_t> roughness_png(const Pattern& p, const std::vector<Texel>& texels) {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(texels.size() * 3);
    for (const Texel& t : texels) pixels.insert(pixels.end(), {255, byte(t.roughness), byte(t.metallic)});
    return encode_png(p.width, p.height, 3, pixels);
}

float ramp(float low, float high, float v) {
    const float t = std::clamp((v - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

// A course of blocks: which block a point is in, and how far it is from the block's edge in metres.
struct Course {
    int column, row;
    Vec2 within;  // metres from the block's upper left corner
    float edge;
};
Course course(Vec2 uv, Vec2 tile, int columns, int rows, float shift) {
    const float y = uv.y * float(rows);
    const int row = int(y);
    float x = uv.x * float(columns) + shift * float(row % 2) + 0.0f;
    const int column = wrap(int(std::floor(x)), columns);
    x -= std::floor(x);
    const Vec2 size = tile / Vec2(columns, rows), in = Vec2(x, y - float(row)) * size;
    return {column, row, in, std::min(std::min(in.x, size.x - in.x), std::min(in.y, size.y - in.y))};
}

// Tables, since the power function would take most of the time: coded bytes to linear, and linear to coded bytes.
const std::array<float, 256> kLinear = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = decode_srgb(float(i) / 255.0f);
    return table;
}();

Rgb srgb(int r, int g, int b) {
    return {kLinear[std::size_t(r)], kLinear[std::size_t(g)], kLinear[std::size_t(b)]};
}

}  // namespace

std::vector<int> add_patterns(Level& level, const std::vector<Pattern>& patterns) {
    struct Made {
        std::vector<std::uint8_t> color, normal, roughness;
        Texel middle;
    };
    std::vector<Made> made(patterns.size());
    tbb::parallel_for(std::size_t(0), patterns.size(), [&](std::size_t i) {
        const Pattern& p = patterns[i];
        const std::vector<Texel> texels = evaluate(p);
        made[i].color = color_png(p, texels);
        if (p.normal_map) made[i].normal = normal_png(p, texels);
        if (p.roughness_map) made[i].roughness = roughness_png(p, texels);
        made[i].middle = texels[texels.size() / 2 + std::size_t(p.width) / 2];
    });
    std::vector<int> surfaces;
    const auto add_picture = [&](const std::string& name, std::vector<std::uint8_t>& png) {
        if (png.empty()) return -1;
        level.pictures.push_back({name, std::move(png)});
        return int(level.pictures.size()) - 1;
    };
    for (std::size_t i = 0; i < patterns.size(); ++i) {
        const Pattern& p = patterns[i];
        Surface s;
        s.name = p.name;
        s.tile = p.tile;
        s.color_picture = add_picture(p.name + " colour", made[i].color);
        s.normal_picture = add_picture(p.name + " normal", made[i].normal);
        s.roughness_picture = add_picture(p.name + " roughness", made[i].roughness);
        s.roughness = p.roughness_map ? 1.0f : made[i].middle.roughness;
        s.metallic = p.roughness_map ? 1.0f : made[i].middle.metallic;
        s.alpha_mode = p.alpha_mode;
        s.double_sided = p.double_sided;
        surfaces.push_back(level.add_surface(s));
    }
    return surfaces;
}

// Monk brick in Flemish-like bond: 8 stretchers to 2.16 m, 20 courses to 1.7 m (old Danish "munkesten" are about
// 26 x 12.5 x 8.5 cm with the joint).
Pattern brick() {
    Pattern p{.name = "brick", .tile = {2.16f, 1.7f}, .width = 768, .height = 768, .texel = {}};
    p.texel = [tile = p.tile](Vec2 uv) {
        const Vec2 bent =
            uv + 0.0014f * Vec2(fractal_noise(uv, 24, 24, 2, 3) - 0.5f, fractal_noise(uv, 24, 24, 2, 4) - 0.5f);
        const Course c = course(glm::fract(bent), tile, 8, 20, 0.5f);
        const float tone = hash_cell(c.column, c.row, 11), hue = hash_cell(c.column, c.row, 12);
        const float grain = fractal_noise(uv, 64, 64, 4, 5), stain = fractal_noise(uv, 4, 4, 4, 6);
        Rgb fired = glm::mix(srgb(142, 74, 54), srgb(176, 98, 70), tone);
        fired = glm::mix(fired, srgb(112, 58, 50), ramp(0.8f, 0.98f, hue));
        fired *= 0.82f + 0.36f * grain;
        const Rgb mortar = srgb(176, 164, 146) * (0.85f + 0.3f * fractal_noise(uv, 128, 128, 2, 8));
        const float joint = 1.0f - ramp(0.004f, 0.0085f, c.edge);
        Texel t;
        t.color = glm::mix(fired, mortar, joint) * (0.86f + 0.28f * stain);
        t.height = -0.0035f * joint + 0.0018f * grain + 0.001f * tone;
        t.roughness = 0.92f;
        return t;
    };
    return p;
}

// Squared sandstone: courses of 0.4 m, stones of 0.8 m in half bond.
Pattern ashlar() {
    Pattern p{.name = "ashlar", .tile = {2.4f, 1.6f}, .texel = {}};
    p.texel = [tile = p.tile](Vec2 uv) {
        const Course c = course(uv, tile, 3, 4, 0.5f);
        const float tone = hash_cell(c.column, c.row, 21);
        const float grain = fractal_noise(uv, 96, 64, 3, 22), vein = fractal_noise(uv, 6, 12, 4, 23);
        const float joint = 1.0f - ramp(0.003f, 0.009f, c.edge);
        Texel t;
        t.color = glm::mix(srgb(186, 170, 142), srgb(203, 190, 164), tone) * (0.8f + 0.22f * vein + 0.14f * grain);
        t.color = glm::mix(t.color, srgb(150, 138, 118), joint);
        t.height = -0.003f * joint + 0.0007f * grain + 0.0012f * vein;
        t.roughness = 0.85f;
        return t;
    };
    return p;
}

Pattern rough_stone() {
    Pattern p{.name = "field stone", .tile = {2.0f, 2.0f}, .texel = {}};
    p.texel = [](Vec2 uv) {
        const Vec2 bent =
            uv + 0.03f * Vec2(fractal_noise(uv, 6, 6, 3, 31) - 0.5f, fractal_noise(uv, 6, 6, 3, 32) - 0.5f);
        const Worley w = worley(bent, 7, 33, 0.75f);
        const float grain = fractal_noise(uv, 48, 48, 4, 34), face = ramp(0.04f, 0.22f, w.second - w.first);
        Texel t;
        t.color = glm::mix(srgb(118, 112, 106), srgb(160, 150, 136), w.id) * (0.72f + 0.5f * grain);
        t.color = glm::mix(srgb(146, 137, 122) * (0.8f + 0.3f * grain), t.color, face);
        t.height = 0.012f * face + 0.004f * grain;
        t.roughness = 0.9f;
        return t;
    };
    return p;
}

Pattern plaster() {
    Pattern p{.name = "lime plaster", .tile = {3.0f, 3.0f}, .texel = {}};
    p.texel = [](Vec2 uv) {
        const float trowel = fractal_noise(uv, 8, 14, 4, 41), grain = fractal_noise(uv, 90, 90, 2, 42);
        const float age = fractal_noise(uv, 3, 3, 5, 43);
        Texel t;
        t.color = glm::mix(srgb(214, 202, 180), srgb(228, 220, 204), age) * (0.93f + 0.08f * trowel + 0.04f * grain);
        t.height = 0.006f * trowel + 0.0006f * grain;
        t.roughness = 0.95f;
        return t;
    };
    return p;
}

// Grain runs along u.
Pattern oak() {
    Pattern p{.name = "oak", .tile = {2.0f, 1.0f}, .texel = {}};
    p.texel = [](Vec2 uv) {
        const float wave = fractal_noise(uv, 3, 6, 3, 51);
        const Vec2 bent = glm::fract(uv + Vec2(0, 0.03f * (wave - 0.5f)));
        const float fibre = fractal_noise(bent, 8, 160, 3, 52), ring = fractal_noise(bent, 2, 24, 3, 53);
        const float pore = ramp(0.62f, 0.75f, fractal_noise(bent, 24, 220, 2, 54));
        Texel t;
        t.color = glm::mix(srgb(96, 66, 42), srgb(142, 102, 66), 0.55f * ring + 0.45f * fibre) * (1.0f - 0.25f * pore);
        t.height = 0.0008f * fibre - 0.0006f * pore;
        t.roughness = 0.62f;
        return t;
    };
    return p;
}

// Boards of 0.2 m along u, half bond every 2 m.
Pattern oak_floor() {
    Pattern p{.name = "oak boards", .tile = {4.0f, 2.0f}, .width = 1024, .texel = {}};
    p.texel = [tile = p.tile](Vec2 uv) {
        const Course c = course(uv, tile, 2, 10, 0.5f);
        const float tone = hash_cell(c.column, c.row, 61);
        const Vec2 own = glm::fract(uv + Vec2(tone, hash_cell(c.column, c.row, 62)));
        const float fibre = fractal_noise(own, 12, 220, 3, 63), ring = fractal_noise(own, 3, 40, 3, 64);
        const float gap = 1.0f - ramp(0.001f, 0.005f, c.edge);
        Texel t;
        t.color = glm::mix(srgb(110, 76, 48), srgb(156, 114, 76), 0.5f * ring + 0.2f * fibre + 0.3f * tone);
        t.color *= 1.0f - 0.75f * gap;
        t.height = -0.003f * gap + 0.0005f * fibre;
        t.roughness = 0.55f;
        return t;
    };
    return p;
}

// Slabs of 0.75 m, pale and dark by turns, with veins; polished.
Pattern marble_floor() {
    Pattern p{.name = "marble", .tile = {3.0f, 3.0f}, .width = 768, .height = 768, .texel = {}, .roughness_map = true};
    p.texel = [tile = p.tile](Vec2 uv) {
        const Course c = course(uv, tile, 4, 4, 0.0f);
        const bool dark = (c.column + c.row) % 2;
        const Vec2 own = glm::fract(uv + Vec2(hash_cell(c.column, c.row, 71), hash_cell(c.column, c.row, 72)));
        const float warp = fractal_noise(own, 4, 4, 5, 73);
        const float vein =
            std::pow(1.0f - std::abs(2.0f * fractal_noise(glm::fract(own + 0.25f * warp), 4, 4, 4, 74) - 1.0f), 14.0f);
        const float joint = 1.0f - ramp(0.0015f, 0.004f, c.edge);
        Texel t;
        t.color = dark ? glm::mix(srgb(74, 78, 76), srgb(142, 140, 130), 0.7f * vein + 0.2f * warp)
                       : glm::mix(srgb(214, 204, 186), srgb(160, 146, 126), 0.6f * vein + 0.2f * warp);
        t.color = glm::mix(t.color, srgb(120, 112, 100), joint);
        t.height = -0.0012f * joint;
        t.roughness = glm::mix(0.24f + 0.06f * warp, 0.8f, joint);
        return t;
    };
    return p;
}

Pattern brass() {
    Pattern p{.name = "brass", .tile = {0.5f, 0.5f}, .texel = {}, .roughness_map = true};
    p.texel = [](Vec2 uv) {
        const float brushed = fractal_noise(uv, 200, 6, 2, 81), patina = fractal_noise(uv, 4, 4, 5, 82);
        const float scratch = ramp(0.72f, 0.8f, fractal_noise(glm::fract(uv + 0.1f * patina), 6, 90, 2, 83));
        Texel t;
        t.color = glm::mix(srgb(214, 178, 98), srgb(182, 142, 74), ramp(0.45f, 0.75f, patina));
        t.height = 0.00004f * brushed - 0.00005f * scratch;
        t.roughness = 0.26f + 0.12f * patina + 0.1f * scratch;
        t.metallic = 1.0f;
        return t;
    };
    return p;
}

Pattern iron() {
    Pattern p{.name = "wrought iron", .tile = {0.5f, 0.5f}, .width = 256, .height = 256, .texel = {}};
    p.texel = [](Vec2 uv) {
        const float hammered = worley(uv, 12, 91).first, rust = fractal_noise(uv, 8, 8, 4, 92);
        Texel t;
        t.color = glm::mix(srgb(66, 64, 63), srgb(92, 72, 58), ramp(0.5f, 0.8f, rust));
        t.height = 0.0012f * hammered;
        t.roughness = 0.55f;
        t.metallic = 0.3f;
        return t;
    };
    return p;
}

namespace {

// Woven threads over a drawing: the drawing gives the dye, the weave height and a little shade.
Texel woven(const Rgb& dye, Vec2 uv, int threads_x, int threads_y) {
    const Vec2 t = uv * Vec2(threads_x, threads_y);
    const bool over = (int(t.x) + int(t.y)) % 2;
    const Vec2 f = glm::fract(t) - 0.5f;
    const float bulge = 1.0f - 2.0f * std::abs(over ? f.y : f.x);
    Texel texel;
    texel.color = dye * (0.78f + 0.22f * bulge) * (0.9f + 0.2f * hash_cell(int(t.x), int(t.y), 101));
    texel.height = 0.0006f * bulge;
    texel.roughness = 0.95f;
    return texel;
}

// A heraldic lion is beyond a formula; three hearts and a chevron are within it. Inside is negative.
float heart(Vec2 p) {
    p.x = std::abs(p.x);
    if (p.y + p.x > 1.0f) return glm::length(p - Vec2(0.25f, 0.75f)) - 0.35355339f;
    const float a = glm::length(p - Vec2(0, 1)), b = glm::length(p - 0.5f * std::max(p.x + p.y, 0.0f));
    return std::min(a, b) * ((p.x > p.y) ? 1.0f : -1.0f);
}

float shield(Vec2 p) {  // p in a box of about 2 x 2.4, centre 0, y up
    p.x = std::abs(p.x);
    const float upper = std::max(p.x - 0.8f, p.y - 0.9f);
    if (p.y > 0.0f) return upper;
    return std::max(glm::length(p - Vec2(-0.65f, 0.0f)) - 1.45f, p.y - 0.9f);
}

}  // namespace

// 2 x 3 m: a field of diamonds with rosettes, a shield with hearts and bars in the middle, a border of scrolls.
Pattern tapestry() {
    Pattern p{.name = "tapestry", .tile = {2.0f, 3.0f}, .width = 768, .height = 1024, .texel = {}};
    p.texel = [](Vec2 uv) {
        const Rgb madder = srgb(132, 38, 36), weld = srgb(204, 162, 78), woad = srgb(38, 58, 98),
                  cream = srgb(220, 204, 168);
        const Vec2 q(2.0f * uv.x - 1.0f, 1.5f - 3.0f * uv.y);  // metres from the middle, y up
        const float border = std::min(1.0f - std::abs(q.x), 1.5f - std::abs(q.y));
        Rgb dye;
        if (border < 0.17f) {
            const float along = 1.0f - std::abs(q.x) < 0.17f ? q.y : q.x;
            const float wave = border - 0.085f - 0.04f * std::sin(along * 18.85f);
            dye = std::abs(wave) < 0.014f || std::abs(border - 0.155f) < 0.012f || border < 0.02f ? weld : woad;
            if (glm::length(Vec2(glm::fract(along * 3.0f + 0.25f) / 3.0f - 0.1667f, border - 0.085f)) < 0.025f)
                dye = cream;
        } else {
            const Vec2 d(glm::fract((q.x + q.y * 0.8f) * 3.0f) - 0.5f, glm::fract((q.x - q.y * 0.8f) * 3.0f) - 0.5f);
            dye = madder * (0.9f + 0.2f * std::abs(d.x));
            if (std::max(std::abs(d.x), std::abs(d.y)) > 0.47f) dye = weld * 0.7f;
            const float petal = glm::length(d) - 0.16f - 0.05f * std::cos(6.0f * std::atan2(d.y, d.x));
            if (petal < 0.0f) dye = petal < -0.1f ? cream : weld;
            const Vec2 s = (q - Vec2(0, 0.1f)) / 0.62f;
            const float edge = shield(s);
            if (edge < 0.06f) dye = weld;
            if (edge < 0.0f) {
                dye = s.x < 0.0f ? weld : woad;
                if (s.x < 0.0f) {
                    for (int i = 0; i < 3; ++i) {
                        const Vec2 h = (s - Vec2(i == 2 ? -0.4f : i ? -0.2f : -0.58f, i == 2 ? -0.45f : 0.3f)) / 0.3f;
                        if (heart(h + Vec2(0, 0.5f)) < 0.0f) dye = madder;
                    }
                } else if (std::abs(glm::fract(s.y * 1.6f + s.x * 0.8f) - 0.5f) < 0.2f) {
                    dye = cream;
                }
            }
        }
        Texel t = woven(dye, uv, 192, 256);
        t.color *= 0.85f + 0.3f * fractal_noise(uv, 4, 6, 4, 103);
        return t;
    };
    return p;
}

// 1 x 2.5 m, red over white with a gold edge, two fishtail points drawn by the mesh.
Pattern banner() {
    Pattern p{.name = "banner", .tile = {1.0f, 2.5f}, .width = 256, .height = 512, .texel = {}, .normal_map = false};
    p.texel = [](Vec2 uv) {
        const Rgb red = srgb(150, 34, 38), white = srgb(224, 214, 194), gold = srgb(204, 160, 72);
        const Vec2 q(uv.x - 0.5f, 2.5f * uv.y);
        Rgb dye = std::abs(q.x + 0.08f) < 0.075f || std::abs(q.y - 0.85f) < 0.075f ? white : red;
        if (0.5f - std::abs(q.x) < 0.035f) dye = gold;
        return woven(dye, uv, 64, 128);
    };
    return p;
}

Pattern linen() {
    Pattern p{.name = "wool", .tile = {0.4f, 0.4f}, .width = 128, .height = 128, .texel = {}};
    p.texel = [](Vec2 uv) { return woven(Rgb(0.82f), uv, 32, 32); };
    return p;
}

// Quarries of 0.16 x 0.24 m between lead cames 16 mm wide; the panes themselves are cut out.
Pattern leaded_glass() {
    Pattern p{.name = "leaded lattice",
              .tile = {0.32f, 0.48f},
              .width = 256,
              .height = 256,
              .texel = {},
              .normal_map = false,
              .alpha_mode = AlphaMode::Mask};
    p.texel = [](Vec2 uv) {
        const float a = std::abs(glm::fract(uv.x + uv.y + 0.5f) - 0.5f),
                    b = std::abs(glm::fract(uv.x - uv.y + 0.5f) - 0.5f);
        // Perpendicular distance to the lines u + v = k and u - v = k on the 0.32 x 0.48 m tile.
        const float metres = std::min(a, b) / glm::length(Vec2(1.0f / 0.32f, 1.0f / 0.48f));
        Texel t;
        t.color = srgb(92, 94, 98);
        t.roughness = 0.5f;
        t.alpha = std::clamp(0.5f + (0.008f - metres) * 400.0f, 0.0f, 1.0f);
        return t;
    };
    return p;
}

Pattern cobbles() {
    Pattern p{.name = "cobbles", .tile = {2.0f, 2.0f}, .width = 768, .height = 768, .texel = {}};
    p.texel = [](Vec2 uv) {
        const Worley w = worley(uv, 15, 111, 0.62f);
        const float dome = ramp(0.02f, 0.42f, w.second - w.first), grain = fractal_noise(uv, 90, 90, 3, 112);
        const float dirt = fractal_noise(uv, 8, 8, 4, 113);
        Texel t;
        const Rgb stone = glm::mix(srgb(128, 120, 112), srgb(172, 160, 144), w.id) * (0.78f + 0.36f * grain);
        t.color = glm::mix(srgb(112, 104, 84) * (0.7f + 0.6f * dirt), stone, ramp(0.05f, 0.22f, dome));
        t.height = 0.016f * dome + 0.002f * grain;
        t.roughness = 0.85f;
        return t;
    };
    return p;
}

Pattern gravel() {
    Pattern p{.name = "gravel", .tile = {1.5f, 1.5f}, .texel = {}};
    p.texel = [](Vec2 uv) {
        const Worley large = worley(uv, 44, 121), small = worley(uv, 90, 122);
        const float patch = fractal_noise(uv, 3, 3, 4, 123);
        const float pebble = std::max(1.0f - 1.5f * large.first, 0.7f - 1.2f * small.first);
        Texel t;
        t.color = glm::mix(srgb(158, 146, 126), srgb(196, 184, 162), 0.5f * large.id + 0.5f * small.id) *
                  (0.62f + 0.35f * std::max(pebble, 0.0f) + 0.2f * patch);
        t.height = 0.008f * pebble;
        t.roughness = 0.95f;
        return t;
    };
    return p;
}

Pattern grass() {
    Pattern p{.name = "grass", .tile = {3.0f, 3.0f}, .texel = {}};
    p.texel = [](Vec2 uv) {
        const float tuft = fractal_noise(uv, 24, 24, 4, 131), blade = fractal_noise(uv, 200, 120, 2, 132);
        const float patch = fractal_noise(uv, 3, 3, 4, 133);
        Texel t;
        t.color = glm::mix(srgb(74, 92, 44), srgb(128, 134, 70), 0.4f * blade + 0.6f * patch) * (0.7f + 0.5f * tuft);
        t.height = 0.02f * tuft + 0.008f * blade;
        t.roughness = 1.0f;
        return t;
    };
    return p;
}

// Interlocking tiles seen from outside, eaves at the bottom: 0.25 x 0.3 m each.
Pattern roof_tiles() {
    Pattern p{.name = "roof tiles", .tile = {2.0f, 1.8f}, .texel = {}};
    p.texel = [tile = p.tile](Vec2 uv) {
        const Course c = course(uv, tile, 8, 6, 0.0f);
        const float across = c.within.x / 0.25f, down = c.within.y / 0.3f, tone = hash_cell(c.column, c.row, 141);
        const float grain = fractal_noise(uv, 48, 48, 3, 142), moss = fractal_noise(uv, 5, 5, 4, 143);
        Texel t;
        t.color = glm::mix(srgb(136, 66, 46), srgb(170, 92, 62), tone) * (0.8f + 0.35f * grain);
        t.color = glm::mix(t.color, srgb(110, 96, 66), 0.35f * ramp(0.55f, 0.75f, moss));
        t.color *= glm::mix(0.55f, 1.0f, ramp(0.0f, 0.06f, std::min(1.0f - down, down + 0.04f)));
        t.height = 0.022f * std::sin(float(2.0 * kPi) * across) + 0.016f * down;
        t.roughness = 0.88f;
        return t;
    };
    return p;
}

// One spray of leaves on a square of 0.6 m, cut out.
Pattern leaves() {
    Pattern p{.name = "leaves",
              .tile = {1.0f, 1.0f},
              .width = 256,
              .height = 256,
              .texel = {},
              .normal_map = false,
              .alpha_mode = AlphaMode::Mask,
              .double_sided = true};
    p.texel = [](Vec2 uv) {
        Texel t;
        t.alpha = 0.0f;
        t.color = srgb(76, 104, 44);
        t.roughness = 0.8f;
        for (int i = 0; i < 22; ++i) {
            const float turn = 6.2832f * hash_cell(i, 0, 151), reach = 0.36f * std::sqrt(hash_cell(i, 1, 151));
            const Vec2 base = Vec2(0.5f) + reach * Vec2(std::cos(turn), std::sin(turn));
            const float lean = turn + 1.8f * (hash_cell(i, 2, 151) - 0.5f);
            const Vec2 d = uv - base, along(std::cos(lean), std::sin(lean));
            const float x = glm::dot(d, along) / 0.11f, y = std::abs(d.x * along.y - d.y * along.x) / 0.05f;
            const float inside = 1.0f - x * x - y - 0.25f * y * y;
            if (inside < 0.0f) continue;
            t.alpha = 1.0f;
            t.color = glm::mix(srgb(66, 94, 36), srgb(124, 146, 66), hash_cell(i, 3, 151)) *
                      (y < 0.08f ? 1.25f : 0.95f + 0.1f * y);
        }
        return t;
    };
    return p;
}

Pattern bark() {
    Pattern p{.name = "bark", .tile = {0.8f, 0.8f}, .width = 256, .height = 256, .texel = {}};
    p.texel = [](Vec2 uv) {
        const float ridge = std::abs(2.0f * fractal_noise(uv, 4, 20, 4, 161) - 1.0f);
        Texel t;
        t.color = glm::mix(srgb(62, 52, 42), srgb(120, 106, 88), ridge);
        t.height = 0.015f * ridge;
        t.roughness = 0.95f;
        return t;
    };
    return p;
}

// A metre of book backs; v is the height of a shelf.
Pattern books() {
    Pattern p{.name = "books", .tile = {1.0f, 0.32f}, .width = 512, .height = 128, .texel = {}};
    p.texel = [](Vec2 uv) {
        const int book = int(uv.x * 22.0f);
        const float in = std::abs(glm::fract(uv.x * 22.0f) - 0.5f), tone = hash_cell(book, 0, 171);
        const Rgb covers[5] = {srgb(110, 48, 38), srgb(86, 62, 40), srgb(52, 66, 54), srgb(64, 52, 74),
                               srgb(150, 124, 84)};
        Texel t;
        t.color = covers[int(tone * 5.0f)] * (0.8f + 0.4f * fractal_noise(uv, 64, 24, 3, 172));
        if (std::abs(glm::fract(uv.y * 3.0f + 0.4f * tone) - 0.5f) < 0.035f) t.color = srgb(190, 152, 84);
        t.height = 0.012f * std::sqrt(std::max(1.0f - 4.0f * in * in, 0.0f));
        if (in > 0.47f) t.color *= 0.25f;
        t.roughness = 0.7f;
        return t;
    };
    return p;
}

}  // namespace daylit::content
