#pragma once
// The demo level and the proof scenes, made by code and written as .glb.
#include <filesystem>
#include <span>
#include <string>

namespace daylit {

struct ContentScene {
    std::string name;     // for `daylit make NAME`
    std::string purpose;  // the one thing that it shows or proves
};
std::span<const ContentScene> content_scenes();

/// throws Error for an unknown name (lists the names) or an unwritable place. Same bytes every time.
void make_scene(const std::string& name, const std::filesystem::path& path);

}  // namespace daylit
