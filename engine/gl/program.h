#pragma once
// GL programs from shader files, which may be changed while they run.
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/units.h"
#include "engine/gl/owners.h"
#include "engine/gl/shader_source.h"

namespace daylit {

/// A shader that does not compile or link. what() is the first error of the log, log() all of it, both with file and
/// line of the source.
class ShaderError : public Error {
  public:
    explicit ShaderError(const std::string& log);
    const std::string& log() const { return log_; }

  private:
    std::string log_;
};

/// A linked program. The stage of a file is its extension: .vert .tesc .tese .geom .frag .comp.
class Program {
  public:
    /// files     relative to shader_root(), e.g. {"shaders/surface.vert", "shaders/surface.frag"}
    /// defines   "NAME" or "NAME VALUE", for every stage
    /// throws Error for unreadable files and unknown extensions, ShaderError for what the compiler refuses
    explicit Program(std::vector<std::string> files, std::vector<std::string> defines = {});

    GLuint get() const { return program_.get(); }
    void use() const { glUseProgram(program_.get()); }

    /// When a file it was made of has changed: compiles again. On success the new program takes over, with all its
    /// uniforms at zero, and the old one is gone. On an error the old one stays and the log is returned.
    /// Empty: nothing changed or all is well.
    std::string reload();

    /// True when the program has an active uniform of this name.
    bool has(const std::string& uniform) const { return location(uniform) >= 0; }

    // Setters act on this program whether or not it is in use. A name that the program does not have (or that the
    // compiler found unused) is left alone, since variants of one shader use different uniforms.
    void set(const std::string& uniform, int value) const;
    void set(const std::string& uniform, unsigned value) const;
    void set(const std::string& uniform, float value) const;
    void set(const std::string& uniform, const Vec2& value) const;
    void set(const std::string& uniform, const Vec3& value) const;
    void set(const std::string& uniform, const Vec4& value) const;
    void set(const std::string& uniform, const Mat3& value) const;
    void set(const std::string& uniform, const Mat4& value) const;
    void set(const std::string& uniform, std::span<const float> values) const;
    void set(const std::string& uniform, std::span<const Vec3> values) const;
    void set(const std::string& uniform, std::span<const Vec4> values) const;
    void set(const std::string& uniform, std::span<const Mat4> values) const;
    // A bool would silently turn into whichever number comes first; GLSL's bool uniforms take an int.
    void set(const std::string& uniform, bool value) const { set(uniform, value ? 1 : 0); }
    void set(const std::string& uniform, double value) const { set(uniform, float(value)); }

  private:
    std::vector<ShaderSource> assemble() const;
    GLint location(const std::string& uniform) const;

    std::vector<std::string> files_, defines_;
    std::vector<ShaderSource> sources_;  // of the last attempt, successful or not
    std::string last_log_;               // of that attempt; empty when it succeeded
    GlProgram program_;
    mutable std::map<std::string, GLint, std::less<>> locations_;
};

}  // namespace daylit
