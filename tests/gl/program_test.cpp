// Programs from files: includes, defines, error places, reload.
#include "engine/gl/program.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/gl/context.h"
#include "engine/gl/target.h"

namespace daylit {
namespace {

/// A shader folder of its own for one test; DAYLIT_SHADER_DIR points at it meanwhile.
class ShaderFolder {
  public:
    explicit ShaderFolder(const std::string& test)
        : path_(std::filesystem::temp_directory_path() / ("daylit_shaders_" + test + std::to_string(::getpid()))) {
        std::filesystem::create_directories(path_ / "shaders");
        ::setenv("DAYLIT_SHADER_DIR", path_.c_str(), 1);
    }
    ~ShaderFolder() {
        ::unsetenv("DAYLIT_SHADER_DIR");
        std::filesystem::remove_all(path_);
    }
    void write(const std::string& file, const std::string& text) const { std::ofstream(path_ / file) << text; }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

const char* const kTriangle = R"(#version 450 core
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1);
}
)";

Rgb draw(const Program& program) {
    const GlTexture texture = make_texture_2d(GL_RGBA32F, 1, 1);
    const GlFramebuffer framebuffer = make_framebuffer({texture.get()});
    const GlVertexArray array = make_vertex_array();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.get());
    glViewport(0, 0, 1, 1);
    glBindVertexArray(array.get());
    program.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    check_gl();
    return read_texture(texture.get(), 1, 1).at(0, 0);
}

std::string frag(const std::string& body) {
    return "#version 450 core\n#include \"shaders/part.glsl\"\nout vec4 color;\n" + body;
}

TEST(ShaderSource, includes_defines_and_numbers_gl) {
    const ShaderFolder folder("source");
    folder.write("shaders/a.frag", "#version 450 core\n#include \"shaders/b.glsl\"\nA3\n");
    folder.write("shaders/b.glsl", "#pragma once\n#include <cmath>\n  # include \"c.glsl\"  // beside\nB4");
    folder.write("shaders/c.glsl", "C1\n");
    const std::vector<std::string> defines = {"ON", "COUNT 3"};
    const ShaderSource source = assemble_shader(folder.path(), "shaders/a.frag", defines);
    EXPECT_EQ(source.text,
              "#version 450 core\n#define ON\n#define COUNT 3\n"
              "#line 1\n\n#line 100001\n\n\n#line 200001\nC1\n#line 100004\nB4\n#line 3\nA3\n");
    EXPECT_EQ(source.files, (std::vector<std::string>{"shaders/a.frag", "shaders/b.glsl", "shaders/c.glsl"}));
}

TEST(ShaderSource, errors_name_the_place_gl) {
    const ShaderFolder folder("errors");
    folder.write("shaders/a.frag", "\n#include \"shaders/gone.glsl\"\n");
    folder.write("shaders/x.glsl", "#include \"shaders/y.glsl\"\n");
    folder.write("shaders/y.glsl", "\n\n#include \"shaders/x.glsl\"\n");
    const auto line = [&](const std::string& file) {
        try {
            assemble_shader(folder.path(), file);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(line("shaders/a.frag").rfind("shaders/a.frag:2: #include of ", 0), 0u) << line("shaders/a.frag");
    EXPECT_EQ(line("shaders/x.glsl").rfind("shaders/y.glsl:3: includes shaders/x.glsl", 0), 0u);
    EXPECT_NE(line("shaders/none.frag").find("none.frag"), std::string::npos);
    ::setenv("DAYLIT_SHADER_DIR", "/nowhere", 1);
    EXPECT_THROW(shader_root(), Error);
}

TEST(ShaderSource, logs_of_three_drivers_gl) {
    const std::vector<std::string> files = {"shaders/a.frag", "shaders/b.glsl"};
    EXPECT_EQ(map_shader_log("0:12(5): error: no", files), "shaders/a.frag:12: error: no");
    EXPECT_EQ(map_shader_log("0(100007) : error C1008: no\n", files), "shaders/b.glsl:7: error C1008: no");
    EXPECT_EQ(map_shader_log("ERROR: 0:100003: 'x' : no\nnote", files), "shaders/b.glsl:3: ERROR: 'x' : no\nnote");
    EXPECT_EQ(map_shader_log("0:700003(1): error: ?", files), "0:700003(1): error: ?");
}

TEST(Programs, uniforms_defines_and_includes_gl) {
    const auto context = make_context(ContextKind::Egl, {.debug = true});
    const ShaderFolder folder("uniforms");
    folder.write("shaders/t.vert", kTriangle);
    folder.write("shaders/part.glsl", "uniform vec3 tint; uniform float gains[3]; uniform mat4 turn; uniform int n;\n");
    folder.write("shaders/t.frag",
                 frag("void main() { color = turn * vec4(tint * gains[2] * float(n) * GAIN, 1); }\n"));
    const Program program({"shaders/t.vert", "shaders/t.frag"}, {"GAIN 0.5"});
    program.set("tint", Vec3(1, 2, 3));
    program.set("gains", std::vector<float>{7, 8, 4});
    program.set("turn", Mat4(1.0f));
    program.set("n", 2);
    program.set("not_there", 1.0f);
    EXPECT_TRUE(program.has("tint"));
    EXPECT_FALSE(program.has("not_there"));
    EXPECT_EQ(draw(program), Rgb(4, 8, 12));
}

TEST(Programs, compile_and_link_errors_have_file_and_line_gl) {
    const auto context = make_context(ContextKind::OsMesa);
    const ShaderFolder folder("compile");
    folder.write("shaders/t.vert", kTriangle);
    folder.write("shaders/part.glsl", "float f() {\n    return missing;\n}\n");
    folder.write("shaders/t.frag", frag("void main() { color = vec4(f()); }\n"));
    const std::vector<std::string> files = {"shaders/t.vert", "shaders/t.frag"};
    try {
        const Program program(files);
        FAIL() << "compiled a missing name";
    } catch (const ShaderError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("shaders/part.glsl:2: ", 0), 0u) << error.what();
    }
    folder.write("shaders/part.glsl", "");
    folder.write("shaders/t.frag", frag("\nvoid main() { color = vec4(1) + oops; }\n"));
    try {
        const Program program(files);
        FAIL() << "compiled a missing name";
    } catch (const ShaderError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("shaders/t.frag:5: ", 0), 0u) << error.what();
    }
    folder.write("shaders/t.frag", frag("in vec3 unfed;\nvoid main() { color = vec4(unfed, 1); }\n"));
    EXPECT_THROW(Program{files}, ShaderError);
    EXPECT_THROW(Program({"shaders/part.glsl"}), Error);
}

TEST(Programs, reload_takes_changes_and_survives_errors_gl) {
    const auto context = make_context(ContextKind::Egl, {.debug = true});
    const ShaderFolder folder("reload");
    folder.write("shaders/t.vert", kTriangle);
    folder.write("shaders/part.glsl", "const float kLevel = 1.0;\n");
    folder.write("shaders/t.frag", frag("void main() { color = vec4(kLevel); }\n"));
    Program program({"shaders/t.vert", "shaders/t.frag"});
    const GLuint first = program.get();
    EXPECT_EQ(program.reload(), "");
    EXPECT_EQ(program.get(), first) << "nothing changed, nothing compiled";

    folder.write("shaders/part.glsl", "const float kLevel = nonsense;\n");
    EXPECT_EQ(program.reload().rfind("shaders/part.glsl:1: ", 0), 0u);
    EXPECT_EQ(program.get(), first) << "the old program stays";
    EXPECT_NE(program.reload(), "") << "still wrong";
    EXPECT_EQ(draw(program), Rgb(1.0f));

    folder.write("shaders/part.glsl", "const float kLevel = 2.0;\n");
    EXPECT_EQ(program.reload(), "");
    EXPECT_EQ(draw(program), Rgb(2.0f)) << "an included file counts";

    std::filesystem::remove(folder.path() / "shaders/part.glsl");
    EXPECT_NE(program.reload(), "");
    EXPECT_EQ(draw(program), Rgb(2.0f));
}

}  // namespace
}  // namespace daylit
