#pragma once
// Finished pieces of an interrupted report, one JSON file each, so that the next start goes on behind them.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace daylit {

class Finished {
  public:
    /// key   everything that the pieces depend on: pieces kept under another key are not found
    Finished(std::filesystem::path folder, nlohmann::json key);

    /// None when absent, damaged or of another key.
    std::optional<nlohmann::json> find(const std::string& name) const;
    void keep(const std::string& name, const nlohmann::json& piece) const;
    /// For what a piece keeps beside its JSON.
    std::filesystem::path path(const std::string& name, const std::string& extension) const;

  private:
    std::filesystem::path folder_;
    nlohmann::json key_;
};

/// Letters, digits, dots and hyphens only; different texts may come out alike.
std::string file_name(const std::string& text);
/// A number for the bytes of a file; 0 when it cannot be read.
std::uint64_t file_hash(const std::filesystem::path& path);

}  // namespace daylit
