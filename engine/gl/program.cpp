#include "engine/gl/program.h"

#include <algorithm>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>

namespace daylit {
namespace {

GLenum stage_of(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension == ".vert") return GL_VERTEX_SHADER;
    if (extension == ".tesc") return GL_TESS_CONTROL_SHADER;
    if (extension == ".tese") return GL_TESS_EVALUATION_SHADER;
    if (extension == ".geom") return GL_GEOMETRY_SHADER;
    if (extension == ".frag") return GL_FRAGMENT_SHADER;
    if (extension == ".comp") return GL_COMPUTE_SHADER;
    throw Error(file, "no shader stage has this extension; use .vert .tesc .tese .geom .frag .comp");
}

std::string log_of(GLuint name, void(GLAD_API_PTR* get_integer)(GLuint, GLenum, GLint*),
                   void(GLAD_API_PTR* get_log)(GLuint, GLsizei, GLsizei*, GLchar*)) {
    GLint length = 0;
    get_integer(name, GL_INFO_LOG_LENGTH, &length);
    std::string log(std::size_t(std::max(length, 1)), '\0');
    GLsizei written = 0;
    get_log(name, GLsizei(log.size()), &written, log.data());
    log.resize(std::size_t(written));
    return log;
}

GlShader compile(const std::string& file, const ShaderSource& source) {
    GlShader shader(glCreateShader(stage_of(file)));
    const char* text = source.text.c_str();
    glShaderSource(shader.get(), 1, &text, nullptr);
    glCompileShader(shader.get());
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    const std::string log = map_shader_log(log_of(shader.get(), glGetShaderiv, glGetShaderInfoLog), source.files);
    throw ShaderError(log.empty() ? file + ": does not compile, and the driver does not say why" : log);
}

GlProgram link(const std::vector<std::string>& files, const std::vector<ShaderSource>& sources) {
    GlProgram program(glCreateProgram());
    for (std::size_t i = 0; i < files.size(); ++i) {
        // Deleting an attached shader only marks it: it lives as long as the program.
        glAttachShader(program.get(), compile(files[i], sources[i]).get());
    }
    glLinkProgram(program.get());
    GLint ok = GL_FALSE;
    glGetProgramiv(program.get(), GL_LINK_STATUS, &ok);
    if (ok) return program;
    std::string stages;
    for (const std::string& file : files) stages += (stages.empty() ? "" : " + ") + file;
    throw ShaderError(stages + ": " + log_of(program.get(), glGetProgramiv, glGetProgramInfoLog));
}

std::string first_error(const std::string& log) {
    const std::size_t found = std::min(log.find("error"), log.find("ERROR"));
    std::size_t begin = found == std::string::npos ? 0 : log.rfind('\n', found);
    begin = begin == std::string::npos ? 0 : begin;
    if (begin < log.size() && log[begin] == '\n') ++begin;
    return log.substr(begin, log.find('\n', begin) - begin);
}

bool same_text(const std::vector<ShaderSource>& a, const std::vector<ShaderSource>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const ShaderSource& x, const ShaderSource& y) { return x.text == y.text; });
}

}  // namespace

ShaderError::ShaderError(const std::string& log) : Error(first_error(log)), log_(log) {}

Program::Program(std::vector<std::string> files, std::vector<std::string> defines)
    : files_(std::move(files)), defines_(std::move(defines)), sources_(assemble()), program_(link(files_, sources_)) {}

std::vector<ShaderSource> Program::assemble() const {
    const std::filesystem::path root = shader_root();
    std::vector<ShaderSource> sources;
    for (const std::string& file : files_) sources.push_back(assemble_shader(root, file, defines_));
    return sources;
}

std::string Program::reload() {
    try {
        std::vector<ShaderSource> sources = assemble();
        if (same_text(sources, sources_)) return last_log_;
        sources_ = std::move(sources);
        program_ = link(files_, sources_);
        locations_.clear();
        last_log_.clear();
    } catch (const ShaderError& error) {
        last_log_ = error.log();
    } catch (const Error& error) {
        return error.what();  // a file is missing just now; nothing was compiled
    }
    return last_log_;
}

GLint Program::location(const std::string& uniform) const {
    const auto found = locations_.find(uniform);
    if (found != locations_.end()) return found->second;
    return locations_.emplace(uniform, glGetUniformLocation(get(), uniform.c_str())).first->second;
}

// GL ignores location -1.
void Program::set(const std::string& uniform, int value) const {
    glProgramUniform1i(get(), location(uniform), value);
}
void Program::set(const std::string& uniform, unsigned value) const {
    glProgramUniform1ui(get(), location(uniform), value);
}
void Program::set(const std::string& uniform, float value) const {
    glProgramUniform1f(get(), location(uniform), value);
}
void Program::set(const std::string& uniform, const Vec2& value) const {
    glProgramUniform2fv(get(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(const std::string& uniform, const Vec3& value) const {
    glProgramUniform3fv(get(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(const std::string& uniform, const Vec4& value) const {
    glProgramUniform4fv(get(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(const std::string& uniform, const Mat3& value) const {
    glProgramUniformMatrix3fv(get(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const std::string& uniform, const Mat4& value) const {
    glProgramUniformMatrix4fv(get(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const std::string& uniform, std::span<const float> values) const {
    glProgramUniform1fv(get(), location(uniform), GLsizei(values.size()), values.data());
}
void Program::set(const std::string& uniform, std::span<const Vec3> values) const {
    if (!values.empty()) {
        glProgramUniform3fv(get(), location(uniform), GLsizei(values.size()), glm::value_ptr(values[0]));
    }
}
void Program::set(const std::string& uniform, std::span<const Vec4> values) const {
    if (!values.empty()) {
        glProgramUniform4fv(get(), location(uniform), GLsizei(values.size()), glm::value_ptr(values[0]));
    }
}
void Program::set(const std::string& uniform, std::span<const Mat4> values) const {
    if (!values.empty()) {
        glProgramUniformMatrix4fv(get(), location(uniform), GLsizei(values.size()), GL_FALSE,
                                  glm::value_ptr(values[0]));
    }
}

}  // namespace daylit
