#include "demo/report/finished.h"

#include <cctype>
#include <cstring>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/random.h"

namespace daylit {

Finished::Finished(std::filesystem::path folder, nlohmann::json key)
    : folder_(std::move(folder)), key_(std::move(key)) {
    std::error_code problem;
    std::filesystem::create_directories(folder_, problem);
    if (problem || !std::filesystem::is_directory(folder_))
        throw Error(folder_.string(), "is no folder and cannot be made one; give another -o");
}

std::optional<nlohmann::json> Finished::find(const std::string& name) const {
    const std::filesystem::path file = path(name, ".json");
    if (!std::filesystem::is_regular_file(file)) return std::nullopt;
    const std::vector<std::uint8_t> bytes = read_file(file);
    const nlohmann::json kept = nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false);
    if (!kept.is_object() || !kept.contains("piece") || kept.value("key", nlohmann::json()) != key_)
        return std::nullopt;
    return kept["piece"];
}

void Finished::keep(const std::string& name, const nlohmann::json& piece) const {
    write_file(path(name, ".json"), nlohmann::json{{"key", key_}, {"piece", piece}}.dump(
                                        1, ' ', false, nlohmann::json::error_handler_t::replace));
}

std::filesystem::path Finished::path(const std::string& name, const std::string& extension) const {
    return folder_ / (file_name(name) + extension);
}

std::string file_name(const std::string& text) {
    std::string name;
    for (const char c : text) name += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' ? c : '_';
    return name;
}

std::uint64_t file_hash(const std::filesystem::path& path) {
    if (!std::filesystem::is_regular_file(path)) return 0;
    std::vector<std::uint8_t> bytes = read_file(path);
    std::uint64_t hash = bytes.size();
    bytes.resize((bytes.size() + 7) / 8 * 8, 0);
    for (std::size_t i = 0; i < bytes.size(); i += 8) {
        std::uint64_t word;
        std::memcpy(&word, &bytes[i], 8);
        hash = mix64(hash ^ word);
    }
    return hash;
}

}  // namespace daylit
