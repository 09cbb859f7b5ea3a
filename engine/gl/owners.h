#pragma once
// Owners of GL objects. Every object must die while a context that knows it is current.
#include <glad/gl.h>

#include <utility>

namespace daylit {

/// Sole owner of one GL name; 0 is empty. Move-assign swaps, so the old name is still deleted, by the source.
template <void (*Delete)(GLuint)>
class GlName {
  public:
    explicit GlName(GLuint name = 0) noexcept : name_(name) {}
    GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlName& operator=(GlName&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlName() {
        if (name_) Delete(name_);
    }
    GLuint get() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  private:
    GLuint name_;
};

inline void delete_buffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
inline void delete_texture(GLuint name) {
    glDeleteTextures(1, &name);
}
inline void delete_framebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}
inline void delete_vertex_array(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
inline void delete_query(GLuint name) {
    glDeleteQueries(1, &name);
}
inline void delete_sampler(GLuint name) {
    glDeleteSamplers(1, &name);
}
inline void delete_shader(GLuint name) {
    glDeleteShader(name);
}
inline void delete_program(GLuint name) {
    glDeleteProgram(name);
}

using GlBuffer = GlName<delete_buffer>;
using GlTexture = GlName<delete_texture>;
using GlFramebuffer = GlName<delete_framebuffer>;
using GlVertexArray = GlName<delete_vertex_array>;
using GlQuery = GlName<delete_query>;
using GlSampler = GlName<delete_sampler>;
using GlShader = GlName<delete_shader>;
using GlProgram = GlName<delete_program>;

// Makers of empty objects, in the direct-state-access form of GL 4.5: they exist at once, without being bound.
inline GlBuffer make_buffer() {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    return GlBuffer(name);
}
inline GlTexture make_texture(GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return GlTexture(name);
}
inline GlFramebuffer make_framebuffer() {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    return GlFramebuffer(name);
}
inline GlVertexArray make_vertex_array() {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    return GlVertexArray(name);
}
inline GlQuery make_query(GLenum target) {
    GLuint name = 0;
    glCreateQueries(target, 1, &name);
    return GlQuery(name);
}
inline GlSampler make_sampler() {
    GLuint name = 0;
    glCreateSamplers(1, &name);
    return GlSampler(name);
}

}  // namespace daylit
