#pragma once
// Textures and framebuffers to draw into, and reading them back.
#include <initializer_list>
#include <span>
#include <vector>

#include "engine/base/image.h"
#include "engine/gl/owners.h"

namespace daylit {

/// Filters, wrap mode and, for depth, comparison; what textures of this project need to say about themselves.
struct TextureLook {
    GLenum min_filter = GL_LINEAR;
    GLenum mag_filter = GL_LINEAR;
    GLenum wrap = GL_CLAMP_TO_EDGE;
    GLenum compare = GL_NONE;  // e.g. GL_GEQUAL: a shadow sampler
};

/// Immutable storage, contents undefined. levels 0: the whole mipmap chain.
GlTexture make_texture_2d(GLenum internal_format, int width, int height, int levels = 1, const TextureLook& look = {});
GlTexture make_texture_array(GLenum internal_format, int width, int height, int layers, int levels = 1,
                             const TextureLook& look = {});
GlTexture make_texture_3d(GLenum internal_format, int width, int height, int depth, const TextureLook& look = {});
GlTexture make_texture_cube_array(GLenum internal_format, int side, int cubes, const TextureLook& look = {});
int mip_levels(int width, int height);

/// A framebuffer of whole textures (level 0; all layers for layered drawing); 0 for no depth.
/// throws std::logic_error when it is not complete.
GlFramebuffer make_framebuffer(std::initializer_list<GLuint> colors, GLuint depth = 0);
/// A depth-only framebuffer of one layer (of an array or cube array: cube * 6 + face).
GlFramebuffer make_depth_layer_framebuffer(GLuint depth_array, int layer);

/// Immutable buffer with these bytes; flags as in glNamedBufferStorage (0: GL may not change it again).
GlBuffer make_buffer(std::span<const std::byte> bytes, GLbitfield flags = 0);
template <typename T>
GlBuffer make_buffer(const std::vector<T>& values, GLbitfield flags = 0) {
    return make_buffer(std::as_bytes(std::span(values)), flags);
}

/// Whether the current context draws on the CPU.
bool software_driver();

/// Level 0 of a 2-D colour texture as linear floats, row 0 on top (GL has it at the bottom).
Image read_texture(GLuint texture, int width, int height);

}  // namespace daylit
