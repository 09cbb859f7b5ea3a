#include "demo/output.h"

#include <unistd.h>

#include <filesystem>

#include "engine/base/error.h"

namespace daylit {

void check_output(const std::string& path, std::initializer_list<const char*> extensions) {
    const std::filesystem::path target(path);
    bool known = false;
    std::string list;
    for (const char* extension : extensions) {
        known = known || target.extension() == extension;
        list += (list.empty() ? "" : " or ") + std::string(extension);
    }
    if (!known) throw Error(path, "cannot tell the format by its name; end it in " + list);
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    if (!std::filesystem::is_directory(folder)) throw Error(path, "there is no folder " + folder.string());
    if (access(folder.c_str(), W_OK) != 0) throw Error(path, "the folder " + folder.string() + " is not writable");
    if (std::filesystem::is_directory(target)) throw Error(path, "is a folder");
}

void check_apart(const std::string& output, std::initializer_list<std::string> inputs) {
    for (const std::string& input : inputs) {
        std::error_code absent;
        if (std::filesystem::equivalent(output, input, absent) && !absent)
            throw Error(output, "is also what is read; write to another file");
    }
}

}  // namespace daylit
