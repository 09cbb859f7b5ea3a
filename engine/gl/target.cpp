#include "engine/gl/target.h"

#include <algorithm>
#include <bit>
#include <sstream>
#include <stdexcept>

namespace daylit {
namespace {

void apply(GLuint texture, const TextureLook& look) {
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GLint(look.min_filter));
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GLint(look.mag_filter));
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GLint(look.wrap));
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GLint(look.wrap));
    glTextureParameteri(texture, GL_TEXTURE_WRAP_R, GLint(look.wrap));
    if (look.compare == GL_NONE) return;
    glTextureParameteri(texture, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(texture, GL_TEXTURE_COMPARE_FUNC, GLint(look.compare));
}

void require_complete(GLuint framebuffer) {
    const GLenum status = glCheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return;
    std::ostringstream text;
    text << "framebuffer is not complete: status 0x" << std::hex << status;
    throw std::logic_error(text.str());
}

}  // namespace

int mip_levels(int width, int height) {
    return int(std::bit_width(unsigned(std::max({width, height, 1}))));
}

GlTexture make_texture_2d(GLenum internal_format, int width, int height, int levels, const TextureLook& look) {
    GlTexture texture = make_texture(GL_TEXTURE_2D);
    const int count = levels > 0 ? levels : mip_levels(width, height);
    glTextureStorage2D(texture.get(), count, internal_format, width, height);
    apply(texture.get(), look);
    return texture;
}

GlTexture make_texture_array(GLenum internal_format, int width, int height, int layers, int levels,
                             const TextureLook& look) {
    GlTexture texture = make_texture(GL_TEXTURE_2D_ARRAY);
    const int count = levels > 0 ? levels : mip_levels(width, height);
    glTextureStorage3D(texture.get(), count, internal_format, width, height, layers);
    apply(texture.get(), look);
    return texture;
}

GlTexture make_texture_3d(GLenum internal_format, int width, int height, int depth, const TextureLook& look) {
    GlTexture texture = make_texture(GL_TEXTURE_3D);
    glTextureStorage3D(texture.get(), 1, internal_format, width, height, depth);
    apply(texture.get(), look);
    return texture;
}

GlTexture make_texture_cube_array(GLenum internal_format, int side, int cubes, const TextureLook& look) {
    GlTexture texture = make_texture(GL_TEXTURE_CUBE_MAP_ARRAY);
    glTextureStorage3D(texture.get(), 1, internal_format, side, side, 6 * cubes);
    apply(texture.get(), look);
    return texture;
}

GlFramebuffer make_framebuffer(std::initializer_list<GLuint> colors, GLuint depth) {
    GlFramebuffer framebuffer = make_framebuffer();
    std::vector<GLenum> buffers;
    for (const GLuint color : colors) {
        buffers.push_back(GLenum(GL_COLOR_ATTACHMENT0 + buffers.size()));
        glNamedFramebufferTexture(framebuffer.get(), buffers.back(), color, 0);
    }
    if (depth) glNamedFramebufferTexture(framebuffer.get(), GL_DEPTH_ATTACHMENT, depth, 0);
    if (buffers.empty()) {
        glNamedFramebufferDrawBuffer(framebuffer.get(), GL_NONE);
        glNamedFramebufferReadBuffer(framebuffer.get(), GL_NONE);
    } else {
        glNamedFramebufferDrawBuffers(framebuffer.get(), GLsizei(buffers.size()), buffers.data());
    }
    require_complete(framebuffer.get());
    return framebuffer;
}

GlFramebuffer make_depth_layer_framebuffer(GLuint depth_array, int layer) {
    GlFramebuffer framebuffer = make_framebuffer();
    glNamedFramebufferTextureLayer(framebuffer.get(), GL_DEPTH_ATTACHMENT, depth_array, 0, layer);
    glNamedFramebufferDrawBuffer(framebuffer.get(), GL_NONE);
    glNamedFramebufferReadBuffer(framebuffer.get(), GL_NONE);
    require_complete(framebuffer.get());
    return framebuffer;
}

GlBuffer make_buffer(std::span<const std::byte> bytes, GLbitfield flags) {
    GlBuffer buffer = make_buffer();
    // GL refuses storage of no bytes; an empty buffer is one unused word.
    const GLsizeiptr size = bytes.empty() ? 4 : GLsizeiptr(bytes.size());
    glNamedBufferStorage(buffer.get(), size, bytes.empty() ? nullptr : bytes.data(), flags);
    return buffer;
}

Image read_texture(GLuint texture, int width, int height) {
    Image image(width, height);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(texture, 0, GL_RGB, GL_FLOAT, GLsizei(image.pixels.size() * sizeof(Rgb)), image.pixels.data());
    for (int y = 0; y < height / 2; ++y) {
        std::swap_ranges(&image.at(0, y), &image.at(0, y) + width, &image.at(0, height - 1 - y));
    }
    return image;
}

bool software_driver() {
    const std::string name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos;
}

}  // namespace daylit
