#pragma once
// Variants of the shaders, compiled when a frame first needs them and never for a feature that no material has.
#include <map>
#include <string>
#include <vector>

#include "engine/gl/program.h"

namespace daylit {

class Programs {
  public:
    /// `vertex` and `fragment` are names in shaders/, such as "surface.vert".
    const Program& get(const std::string& vertex, const std::string& fragment,
                       const std::vector<std::string>& defines = {});
    std::size_t count() const { return programs_.size(); }
    /// Compiles again what changed on disk; the logs of those that failed (their old versions stay).
    std::string reload();

  private:
    std::map<std::vector<std::string>, Program> programs_;
};

}  // namespace daylit
