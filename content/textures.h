#pragma once
// Procedural, tileable textures: colour, normal map from height, roughness and metalness.
#include <functional>
#include <string>
#include <vector>

#include "content/level.h"

namespace daylit::content {

/// One point of a material.
struct Texel {
    Rgb color = Rgb(0.5f);  // linear albedo
    float height = 0.0f;    // metres
    float roughness = 1.0f;
    float metallic = 0.0f;
    float alpha = 1.0f;
};

struct Pattern {
    std::string name;
    Vec2 tile = Vec2(1.0f);  // metres a repeat
    int width = 512, height = 512;
    std::function<Texel(Vec2 uv)> texel;  // uv in [0,1), v down
    bool normal_map = true;
    bool roughness_map = false;
    AlphaMode alpha_mode = AlphaMode::Opaque;
    bool double_sided = false;
};

/// Turns patterns into pictures and surfaces, in parallel; surfaces come in the order of the patterns.
/// Without a roughness map, the factors are the texel's at the middle.
std::vector<int> add_patterns(Level& level, const std::vector<Pattern>& patterns);

Pattern brick(), ashlar(), plaster(), oak(), oak_floor(), marble_floor(), brass(), tapestry(), banner(), iron();
Pattern leaded_glass(), cobbles(), gravel(), grass(), roof_tiles(), leaves(), bark(), books(), rough_stone(), linen();

}  // namespace daylit::content
