// Move semantics of GlName, and the helpers that make objects.
#include "engine/gl/owners.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>
#include <vector>

#include "engine/gl/context.h"
#include "engine/gl/target.h"

namespace daylit {
namespace {

std::vector<GLuint> deleted;
void record(GLuint name) {
    deleted.push_back(name);
}
using Recorded = GlName<record>;

static_assert(std::is_nothrow_move_constructible_v<Recorded> && std::is_nothrow_move_assignable_v<Recorded>);
static_assert(!std::is_copy_constructible_v<Recorded> && !std::is_copy_assignable_v<Recorded>);

TEST(Owners, every_name_is_deleted_once_gl) {
    deleted.clear();
    {
        Recorded a(1);
        Recorded b(std::move(a));
        EXPECT_EQ(a.get(), 0u);
        EXPECT_EQ(b.get(), 1u);
        {
            Recorded c(2);
            b = std::move(c);
            EXPECT_EQ(b.get(), 2u);
            EXPECT_EQ(c.get(), 1u) << "move-assign hands the old name over";
        }
        EXPECT_EQ(deleted, std::vector<GLuint>({1}));
        const Recorded empty;
        EXPECT_FALSE(empty);
    }
    EXPECT_EQ(deleted, std::vector<GLuint>({1, 2}));
}

TEST(Owners, objects_exist_until_their_owner_dies_gl) {
    const auto context = make_context(ContextKind::Egl, {.debug = true});
    GLuint names[6];
    {
        const GlBuffer buffer = make_buffer();
        const GlTexture texture = make_texture(GL_TEXTURE_2D);
        const GlFramebuffer framebuffer = make_framebuffer();
        const GlVertexArray array = make_vertex_array();
        const GlQuery query = make_query(GL_TIME_ELAPSED);
        const GlSampler sampler = make_sampler();
        const GLuint made[] = {buffer.get(), texture.get(), framebuffer.get(), array.get(), query.get(), sampler.get()};
        std::copy(std::begin(made), std::end(made), names);
        EXPECT_TRUE(glIsBuffer(names[0]) && glIsTexture(names[1]) && glIsFramebuffer(names[2]));
        EXPECT_TRUE(glIsVertexArray(names[3]) && glIsQuery(names[4]) && glIsSampler(names[5]));
    }
    EXPECT_FALSE(glIsBuffer(names[0]) || glIsTexture(names[1]) || glIsFramebuffer(names[2]));
    EXPECT_FALSE(glIsVertexArray(names[3]) || glIsQuery(names[4]) || glIsSampler(names[5]));
    check_gl();
}

TEST(Targets, read_back_has_row_0_on_top_gl) {
    const auto context = make_context(ContextKind::Egl, {.debug = true});
    const GlTexture texture = make_texture_2d(GL_RGBA16F, 2, 3);
    for (int y = 0; y < 3; ++y) {
        const float row[] = {float(y), 0, 0, 1, float(y), 1, 0, 1};
        glTextureSubImage2D(texture.get(), 0, 0, y, 2, 1, GL_RGBA, GL_FLOAT, row);
    }
    const Image image = read_texture(texture.get(), 2, 3);
    EXPECT_EQ(image.at(0, 0), Rgb(2, 0, 0)) << "GL's last row is the picture's first";
    EXPECT_EQ(image.at(1, 2), Rgb(0, 1, 0));
    check_gl();
}

TEST(Targets, layers_and_levels_gl) {
    const auto context = make_context(ContextKind::Egl, {.debug = true});
    EXPECT_EQ(mip_levels(1, 1), 1);
    EXPECT_EQ(mip_levels(1280, 720), 11);
    const GlTexture array = make_texture_array(GL_DEPTH_COMPONENT32F, 8, 8, 3, 1, {.compare = GL_GEQUAL});
    const GlTexture cubes = make_texture_cube_array(GL_DEPTH_COMPONENT24, 8, 2);
    EXPECT_TRUE(make_depth_layer_framebuffer(array.get(), 2));
    EXPECT_TRUE(make_depth_layer_framebuffer(cubes.get(), 11));
    EXPECT_THROW(make_depth_layer_framebuffer(array.get(), 3), std::logic_error);
    EXPECT_TRUE(make_buffer(std::vector<float>{}));
}

}  // namespace
}  // namespace daylit
