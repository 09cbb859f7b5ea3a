#pragma once
// What a context of any platform must do. tests/gl has the platforms without a display, tests/window the one with.
#include "engine/gl/context.h"

#include <glad/gl.h>
#include <gtest/gtest.h>

#include <string>

#include "engine/gl/target.h"

namespace daylit::context_tests {

/// Draws into a texture and reads it back: proof that the loaded functions belong to the current context.
inline Rgb clear_and_read(const Rgb& color) {
    const GlTexture texture = make_texture_2d(GL_RGBA32F, 4, 3);
    const GlFramebuffer framebuffer = make_framebuffer({texture.get()});
    const float rgba[] = {color.r, color.g, color.b, 1.0f};
    glClearNamedFramebufferfv(framebuffer.get(), GL_COLOR, 0, rgba);
    return read_texture(texture.get(), 4, 3).at(3, 2);
}

class Contexts : public testing::TestWithParam<ContextKind> {};

TEST_P(Contexts, gives_4_5_core_gl) {
    const auto context = make_context(GetParam());
    GLint major = 0, minor = 0, profile = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_GE(major * 10 + minor, 45);
    EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_NE(context->description().find("OpenGL 4."), std::string::npos) << context->description();
    EXPECT_EQ(context->window() != nullptr, GetParam() == ContextKind::Glfw);
}

TEST_P(Contexts, draws_one_after_another_gl) {
    for (int i = 1; i <= 3; ++i) {
        const auto context = make_context(GetParam());
        EXPECT_EQ(clear_and_read(Rgb(float(i))), Rgb(float(i)));
    }
}

TEST_P(Contexts, two_side_by_side_keep_their_objects_gl) {
    const auto first = make_context(GetParam());
    const GlTexture of_first = make_texture(GL_TEXTURE_2D);
    {
        const auto second = make_context(GetParam());
        EXPECT_FALSE(glIsTexture(of_first.get()));
        EXPECT_EQ(clear_and_read(Rgb(0.5f)), Rgb(0.5f));
    }
    first->make_current();
    EXPECT_TRUE(glIsTexture(of_first.get()));
}

TEST_P(Contexts, debug_output_becomes_an_exception_gl) {
    const auto context = make_context(GetParam(), {.debug = true});
    EXPECT_NO_THROW(check_gl());
    glEnable(GL_RENDERER);  // not a capability
    try {
        check_gl();
        FAIL() << "an invalid enum went unnoticed";
    } catch (const std::logic_error& error) {
        EXPECT_NE(std::string(error.what()).find("GL_INVALID_ENUM"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(check_gl()) << "messages are told once";
}

inline std::string kind_name(const testing::TestParamInfo<ContextKind>& info) {
    return name(info.param);
}

}  // namespace daylit::context_tests
