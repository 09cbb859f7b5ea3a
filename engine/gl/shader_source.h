#pragma once
// Shader files put together for the compiler: includes, defines, and the way back from its log to file and line.
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace daylit {

/// The folder that holds shaders/; every path below is relative to it. In this order: the environment's
/// DAYLIT_SHADER_DIR, the source tree that this was built from, the installed share folder, share/daylit beside the
/// running program's bin. throws Error when none of them has shaders/.
std::filesystem::path shader_root();

/// The file is told by the line number rather than by #line's source-string number, which Mesa forgets in all but
/// syntax errors (its YYLLOC_DEFAULT resets it).
inline constexpr unsigned kLinesPerFile = 100000;

/// One stage as the compiler gets it.
struct ShaderSource {
    std::string text;
    /// Line l of files[n] has the line number n * kLinesPerFile + l in the text; [0] is the stage's own file, the
    /// others are what it includes.
    std::vector<std::string> files;
};

/// Reads `file` under `root`. `#include "shaders/shared/brdf.h"` is replaced by that file, looked for under the root
/// and then beside the file that includes it; includes in angle brackets are C++'s alone and are left out. Included
/// files guard themselves, as in C. The text starts with the stage's #version line (450 core when it has none), then
/// the defines ("NAME" or "NAME VALUE"). throws Error for unreadable files, with the place of the #include, and for
/// include cycles.
ShaderSource assemble_shader(const std::filesystem::path& root, const std::string& file,
                             std::span<const std::string> defines = {});

/// A compiler's log with its places replaced: "shaders/surface.frag:12: error: ...". Understands the forms
/// "0:12(5): ..." (Mesa), "0(12) : ..." (NVIDIA) and "ERROR: 0:12: ..." (the Khronos front end).
std::string map_shader_log(const std::string& log, std::span<const std::string> files);

}  // namespace daylit
