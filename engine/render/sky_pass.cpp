#include "engine/render/sky_pass.h"

#include "engine/gl/target.h"

namespace daylit {

void SkyPass::set_environment(const Environment& sky) {
    const Image& map = sky.map;
    if (texture_ && map.width == map_.width && map.height == map_.height && map.pixels == map_.pixels) return;
    black_ = map.empty() || sky.black();
    const bool same_size = texture_ && map.width == map_.width && map.height == map_.height;
    map_ = map.empty() ? Image(1, 1) : map;
    if (!same_size) {
        texture_ = make_texture_2d(GL_RGB32F, map_.width, map_.height);
        glTextureParameteri(texture_.get(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture_.get(), 0, 0, 0, map_.width, map_.height, GL_RGB, GL_FLOAT, map_.pixels.data());
}

DrawCount SkyPass::draw(Programs& programs, std::size_t suns) const {
    std::vector<std::string> defines;
    if (suns > 0) defines.push_back("SUNS " + std::to_string(suns));
    programs.get("fullscreen.vert", "sky.frag", defines).use();
    bind_texture(9, texture_.get());
    glDepthFunc(GL_GEQUAL);  // the triangle lies at the far plane itself
    glDepthMask(GL_FALSE);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    return {1, 1, 0, 0};
}

}  // namespace daylit
