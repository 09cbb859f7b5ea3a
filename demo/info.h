#pragma once
// What a baked file holds, for `info` and at the end of `bake`.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace daylit {

nlohmann::json describe_baked(const std::filesystem::path& path);

/// The same for people, several lines without a final newline.
std::string summary(const nlohmann::json& about);

}  // namespace daylit
