#include "engine/gl/shader_source.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <regex>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace daylit {
namespace {

constexpr std::size_t kMaxShaderBytes = std::size_t(1) << 22;

std::optional<std::string> quoted_include(const std::string& line) {
    static const std::regex pattern(R"rx(^\s*#\s*include\s*"([^"]+)".*)rx");
    std::smatch match;
    if (!std::regex_match(line, match, pattern)) return {};
    return match[1].str();
}

bool directive(const std::string& line, const std::string& name) {
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') return false;
    const std::size_t word = line.find_first_not_of(" \t", hash + 1);
    return word != std::string::npos && line.compare(word, name.size(), name) == 0;
}

class Assembler {
  public:
    Assembler(const std::filesystem::path& root, std::span<const std::string> defines)
        : root_(root), defines_(defines) {}

    ShaderSource assemble(const std::string& file) {
        add(file, "");
        std::string head = (version_.empty() ? "#version 450 core" : version_) + "\n";
        for (const std::string& define : defines_) head += "#define " + define + "\n";
        return {head + body_, std::move(files_)};
    }

  private:
    void add(const std::string& file, const std::string& included_at) {
        if (std::find(stack_.begin(), stack_.end(), file) != stack_.end()) {
            throw Error(included_at, "includes " + file + ", which is including it; break the circle");
        }
        stack_.push_back(file);
        const std::size_t number = number_of(file);
        std::istringstream lines(read(file, included_at));
        body_ += line_directive(1, number);
        int line_number = 0;
        for (std::string line; std::getline(lines, line);) add_line(line, file, number, ++line_number);
        stack_.pop_back();
    }

    // Lines that the compiler may not see become empty, so that the others keep their numbers.
    void add_line(const std::string& line, const std::string& file, std::size_t number, int line_number) {
        if (const std::optional<std::string> target = quoted_include(line)) {
            const std::string place = file + ":" + std::to_string(line_number);
            add(resolve(*target, file), place);
            body_ += line_directive(line_number + 1, number);
        } else if (directive(line, "version") && stack_.size() == 1 && version_.empty()) {
            version_ = line;
            body_ += "\n";
        } else if (directive(line, "include") || directive(line, "pragma once")) {
            body_ += "\n";
        } else {
            body_ += line + "\n";
        }
    }

    std::string resolve(const std::string& target, const std::string& from) const {
        const std::filesystem::path beside = std::filesystem::path(from).parent_path() / target;
        if (!std::filesystem::exists(root_ / target) && std::filesystem::exists(root_ / beside)) {
            return beside.lexically_normal().string();
        }
        return std::filesystem::path(target).lexically_normal().string();
    }

    std::string read(const std::string& file, const std::string& included_at) const {
        try {
            const std::vector<std::uint8_t> bytes = read_file(root_ / file, kMaxShaderBytes);
            return std::string(bytes.begin(), bytes.end());
        } catch (const Error& error) {
            if (included_at.empty()) throw;
            throw Error(included_at, std::string("#include of ") + error.what());
        }
    }

    std::size_t number_of(const std::string& file) {
        const auto found = std::find(files_.begin(), files_.end(), file);
        if (found == files_.end()) {
            files_.push_back(file);
            return files_.size() - 1;
        }
        return std::size_t(found - files_.begin());
    }

    // Since GLSL 3.30 the line after "#line n" has the number n.
    static std::string line_directive(int line, std::size_t number) {
        return "#line " + std::to_string(number * kLinesPerFile + std::size_t(line)) + "\n";
    }

    std::filesystem::path root_;
    std::span<const std::string> defines_;
    std::string version_, body_;
    std::vector<std::string> files_;
    std::vector<std::string> stack_;
};

}  // namespace

std::filesystem::path shader_root() {
    std::vector<std::filesystem::path> candidates;
    const char* given = std::getenv("DAYLIT_SHADER_DIR");
    if (given && *given) {
        if (std::filesystem::is_directory(std::filesystem::path(given) / "shaders")) return given;
        throw Error("DAYLIT_SHADER_DIR", std::string("'") + given + "' has no folder shaders in it");
    }
    candidates.emplace_back(DAYLIT_SHADER_DIR);
    candidates.emplace_back(DAYLIT_INSTALLED_SHADER_DIR);
    std::error_code ignored;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    if (!program.empty()) candidates.push_back(program.parent_path().parent_path() / "share" / "daylit");
    for (const std::filesystem::path& candidate : candidates) {
        if (std::filesystem::is_directory(candidate / "shaders", ignored)) return candidate;
    }
    throw Error("shaders", "no folder with daylit's shaders; set DAYLIT_SHADER_DIR to the one that holds shaders/");
}

ShaderSource assemble_shader(const std::filesystem::path& root, const std::string& file,
                             std::span<const std::string> defines) {
    return Assembler(root, defines).assemble(file);
}

std::string map_shader_log(const std::string& log, std::span<const std::string> files) {
    static const std::regex place(
        R"(^((?:ERROR|WARNING):\s*)?\d+(?::(\d{1,9})(?:\(\d+\))?|\((\d{1,9})\))\s*:\s*(.*)$)");
    std::string mapped;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        if (!mapped.empty()) mapped += "\n";
        std::smatch match;
        const bool placed = std::regex_match(line, match, place);
        const unsigned long number = placed ? std::stoul(match[2].matched ? match[2] : match[3]) : 0;
        if (!placed || number / kLinesPerFile >= files.size()) {
            mapped += line;
            continue;
        }
        mapped += files[number / kLinesPerFile] + ":" + std::to_string(number % kLinesPerFile) + ": " + match[1].str() +
                  match[4].str();
    }
    return mapped;
}

}  // namespace daylit
