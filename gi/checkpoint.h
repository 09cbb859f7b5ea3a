#pragma once
// What a bake has traced so far, on the disk, so that a killed bake goes on where it was.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <vector>

namespace daylit {

/// xxHash64, for keys.
std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed);

/// Numbered blocks of bytes, appended one by one; each has a checksum, so that one cut off by a kill is left out.
/// A disk that takes no more ends the keeping, not the bake.
class Checkpoint {
  public:
    /// Keeps nothing.
    Checkpoint() = default;
    /// key      of everything that the blocks depend on
    /// resume   take what the file holds under the same key; else, and where it is another's, the file starts anew
    Checkpoint(const std::filesystem::path& path, std::uint64_t key, bool resume);

    /// Fills `parts` with the block that was kept under this number with parts of just these sizes.
    bool load(std::uint64_t block, std::span<const std::span<std::byte>> parts);
    void store(std::uint64_t block, std::span<const std::span<const std::byte>> parts);
    std::size_t blocks() const { return places_.size(); }

  private:
    void scan();

    std::fstream file_;
    std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>>
        places_;  // of each block: place in the file, bytes
};

}  // namespace daylit
