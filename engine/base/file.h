#pragma once
// Reading files whole, and writing them whole or not at all.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace daylit {

/// The bytes of a regular file. throws Error when it is absent, a folder, or larger than `limit` bytes.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path,
                                    std::size_t limit = std::size_t(4) << 30);

/// Calls `write` with the path of a temporary file beside `path`, then renames it over `path`. When `write` throws,
/// or the rename fails, the temporary is removed and what was at `path` stays as it was.
/// The temporary keeps the extension of `path`, since image writers choose their format by it.
void write_whole(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path& temporary)>& write);

/// write_whole of these bytes.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace daylit
