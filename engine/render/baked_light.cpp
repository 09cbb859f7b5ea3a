#include "engine/render/baked_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "engine/gl/target.h"

namespace daylit {
namespace {

constexpr int kPerLayer = 4;  // patterns in the channels of one layer

/// A layer's four patterns as halves, texel by texel. planes: the first slot's numbers; slots lie `stride` apart
std::vector<std::uint16_t> layer_halves(const DayLightmap& map, int layer, const std::int16_t* planes,
                                        std::size_t stride) {
    std::array<float, DayLightmap::kLargestExponent + 1> scale;
    for (std::size_t e = 0; e < scale.size(); ++e) scale[e] = std::ldexp(1.0f, -2 * int(e));
    std::vector<std::uint16_t> halves(kPerLayer * map.texels(), 0);
    const std::size_t width = std::size_t(map.width);
    tbb::parallel_for(0, map.height, [&](int y) {
        for (int slot = layer * kPerLayer; slot < std::min((layer + 1) * kPerLayer, map.slots()); ++slot) {
            const std::int16_t* plane = planes + std::size_t(slot) * stride;
            for (std::size_t t = std::size_t(y) * width; t < (std::size_t(y) + 1) * width; ++t)
                if (plane[t] != 0)
                    halves[kPerLayer * t + std::size_t(slot % kPerLayer)] =
                        glm::packHalf1x16(float(plane[t]) * scale[map.exponents[t]]);
        }
    });
    return halves;
}

void check_size(const DayLightmap& map) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (map.width > largest || map.height > largest)
        throw Error("lightmap", std::to_string(map.width) + "x" + std::to_string(map.height) +
                                    " is more than this driver's " + std::to_string(largest) +
                                    " texels; bake with a larger --error");
}

}  // namespace

BakedLight::BakedLight(const DayLightmap& lightmap) {
    check_size(lightmap);
    const int layers = std::max(1, (lightmap.slots() + kPerLayer - 1) / kPerLayer);
    const TextureLook nearest{GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_NONE};
    const bool tilted = lightmap.tilted();
    values_ = make_texture_array(GL_RGBA16F, lightmap.width, lightmap.height, tilted ? 3 * layers : layers, 1, nearest);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const auto upload = [&](int to, int layer, const std::int16_t* planes, std::size_t stride) {
        glTextureSubImage3D(values_.get(), 0, 0, 0, to, lightmap.width, lightmap.height, 1, GL_RGBA, GL_HALF_FLOAT,
                            layer_halves(lightmap, layer, planes, stride).data());
    };
    const std::size_t texels = lightmap.texels();
    for (int layer = 0; layer < layers; ++layer) {
        upload(layer, layer, lightmap.values.data(), texels);
        for (int axis = 0; tilted && axis < 2; ++axis)
            upload((1 + axis) * layers + layer, layer, lightmap.tilts.data() + std::size_t(axis) * texels, 2 * texels);
    }
    irradiance_ = make_texture_2d(GL_RGBA16F, lightmap.width, lightmap.height);
    framebuffer_ = make_framebuffer({irradiance_.get()});
    if (tilted) {
        for (GlTexture& tilt : tilts_) tilt = make_texture_2d(GL_RGBA16F, lightmap.width, lightmap.height);
        tilted_framebuffer_ = make_framebuffer({irradiance_.get(), tilts_[0].get(), tilts_[1].get()});
    }
    constexpr float kBlack[] = {0.0f, 0.0f, 0.0f, 1.0f};
    for (GLint buffer = 0; buffer < (tilted ? 3 : 1); ++buffer)  // tiles without light stay so
        glClearNamedFramebufferfv(tilted ? tilted_framebuffer_.get() : framebuffer_.get(), GL_COLOR, buffer, kBlack);
    map_ = lightmap;
    map_.values = {}, map_.tilts = {}, map_.exponents = {}, map_.corner_uvs = {};
    std::vector<std::uint32_t> tiles;
    for (std::uint32_t tile = 0; tile < map_.tile_patterns.size(); ++tile)
        if (map_.tile_patterns[tile] > 0) tiles.push_back(tile);
    std::stable_partition(tiles.begin(), tiles.end(), [&](std::uint32_t tile) { return plain(tile); });
    relit_ = RelitTiles(std::move(tiles));
    light_buffer_ = make_buffer(std::vector<Vec4>(map_.tiles() * DayLightmap::kMostPatterns), GL_DYNAMIC_STORAGE_BIT);
    tile_buffer_ = make_buffer(std::vector<std::uint32_t>(map_.tiles()), GL_DYNAMIC_STORAGE_BIT);
}

bool BakedLight::stale(const LightScales& scales, double hour) const {
    return !lit_ || map_.basis.weights(scales, hour) != weights_;
}

void BakedLight::upload(std::vector<Rgb> weights) {
    weights_ = std::move(weights);
    lit_ = true;
    relit_.forget();
    std::vector<Vec4> light;
    for (const Rgb& l : map_.tile_light(weights_)) light.emplace_back(l, 0.0f);
    for (std::size_t tile = 0; tile < map_.tile_patterns.size(); ++tile)
        light[tile * DayLightmap::kMostPatterns].w = float((map_.tile_patterns[tile] + kPerLayer - 1) / kPerLayer);
    glNamedBufferSubData(light_buffer_.get(), 0, GLsizeiptr(light.size() * sizeof(Vec4)), light.data());
}

int BakedLight::set_light(const LightScales& scales, double hour, const Frustum& seen, Programs& programs) {
    std::vector<Rgb> weights = map_.basis.weights(scales, hour);
    if (!lit_ || weights != weights_) upload(std::move(weights));
    const std::vector<std::uint32_t> tiles = relit_.take_unlit(seen);
    if (tiles.empty()) return 0;
    const std::size_t plain_tiles = std::size_t(
        std::find_if_not(tiles.begin(), tiles.end(), [&](std::uint32_t t) { return plain(t); }) - tiles.begin());
    glNamedBufferSubData(tile_buffer_.get(), 0, GLsizeiptr(tiles.size() * sizeof tiles[0]), tiles.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, light_buffer_.get());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, tile_buffer_.get());
    glBindTextureUnit(0, values_.get());
    glBindSampler(0, 0);
    glViewport(0, 0, map_.width, map_.height);
    glDisable(GL_DEPTH_TEST);
    const auto relight = [&](GLuint framebuffer, const std::vector<std::string>& defines, std::size_t first,
                             std::size_t last) {
        if (first == last) return;
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        programs.get("relight.vert", "relight.frag", defines).use();
        glUniform1ui(0, GLuint(first));
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(last - first));
    };
    relight(framebuffer_.get(), {}, 0, plain_tiles);
    relight(tilted_framebuffer_.get(), {"TILTED"}, plain_tiles, tiles.size());
    glEnable(GL_DEPTH_TEST);
    return int(tiles.size());
}

void BakedLight::bind() const {
    const auto bind = [](GLuint unit, GLuint texture) {
        glBindTextureUnit(unit, texture);
        glBindSampler(unit, 0);
    };
    bind(4, irradiance_.get());
    if (tilted()) bind(10, tilts_[0].get()), bind(11, tilts_[1].get());
}

}  // namespace daylit
