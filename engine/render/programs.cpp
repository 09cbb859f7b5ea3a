#include "engine/render/programs.h"

namespace daylit {

const Program& Programs::get(const std::string& vertex, const std::string& fragment,
                             const std::vector<std::string>& defines) {
    std::vector<std::string> key = {"shaders/" + vertex, "shaders/" + fragment};
    key.insert(key.end(), defines.begin(), defines.end());
    const auto found = programs_.find(key);
    if (found != programs_.end()) return found->second;
    Program program({key[0], key[1]}, defines);
    return programs_.emplace(std::move(key), std::move(program)).first->second;
}

std::string Programs::reload() {
    std::string logs;
    for (auto& [key, program] : programs_) {
        const std::string log = program.reload();
        if (!log.empty() && logs.find(log) == std::string::npos) logs += log;
    }
    return logs;
}

}  // namespace daylit
