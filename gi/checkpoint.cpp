#include "gi/checkpoint.h"

#include <xxhash.h>

#include <memory>
#include <numeric>

namespace daylit {
namespace {

constexpr std::uint64_t kMagic = 0x31545041524B4344ull;

struct FileHeader {
    std::uint64_t magic = kMagic, key = 0;
};
struct BlockHeader {
    std::uint64_t block = 0, bytes = 0, hash = 0;
};

template <class Part>
std::uint64_t bytes_of(std::span<const Part> parts) {
    return std::accumulate(parts.begin(), parts.end(), std::uint64_t(0),
                           [](std::uint64_t sum, const Part& part) { return sum + part.size(); });
}

template <class Part>
std::uint64_t hash_of(std::uint64_t block, std::span<const Part> parts) {
    const std::unique_ptr<XXH64_state_t, XXH_errorcode (*)(XXH64_state_t*)> state(XXH64_createState(), XXH64_freeState);
    XXH64_reset(state.get(), block);
    for (const Part& part : parts) XXH64_update(state.get(), part.data(), part.size());
    return XXH64_digest(state.get());
}

}  // namespace

std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH64(bytes.data(), bytes.size(), seed);
}

Checkpoint::Checkpoint(const std::filesystem::path& path, std::uint64_t key, bool resume) {
    constexpr auto kBoth = std::ios::binary | std::ios::in | std::ios::out;
    if (resume) {
        file_.open(path, kBoth);
        FileHeader header{0, 0};
        if (file_.read(reinterpret_cast<char*>(&header), sizeof header) && header.magic == kMagic &&
            header.key == key) {
            scan();
            return;
        }
        file_.close();
        file_.clear();
    }
    file_.open(path, kBoth | std::ios::trunc);
    const FileHeader header{kMagic, key};
    file_.write(reinterpret_cast<const char*>(&header), sizeof header);
    file_.flush();
}

void Checkpoint::scan() {
    std::uint64_t at = sizeof(FileHeader);
    file_.seekg(0, std::ios::end);
    const std::uint64_t end = std::uint64_t(file_.tellg());
    BlockHeader header;
    while (at + sizeof header <= end) {
        file_.seekg(std::streamoff(at));
        if (!file_.read(reinterpret_cast<char*>(&header), sizeof header) || header.bytes > end - at - sizeof header)
            break;
        places_[header.block] = {at, header.bytes};
        at += sizeof header + header.bytes;
    }
    file_.clear();
    file_.seekp(std::streamoff(at));  // over whatever a kill cut off
}

bool Checkpoint::load(std::uint64_t block, std::span<const std::span<std::byte>> parts) {
    const auto found = places_.find(block);
    if (found == places_.end() || found->second.second != bytes_of(parts)) return false;
    const std::streampos end = file_.tellp();
    BlockHeader header;
    file_.seekg(std::streamoff(found->second.first));
    file_.read(reinterpret_cast<char*>(&header), sizeof header);
    for (const std::span<std::byte>& part : parts)
        file_.read(reinterpret_cast<char*>(part.data()), std::streamsize(part.size()));
    const bool whole = bool(file_) && header.block == block && header.hash == hash_of(block, parts);
    file_.clear();
    file_.seekp(end);
    return whole;
}

void Checkpoint::store(std::uint64_t block, std::span<const std::span<const std::byte>> parts) {
    if (!file_.is_open() || !file_) return;
    const BlockHeader header{block, bytes_of(parts), hash_of(block, parts)};
    file_.write(reinterpret_cast<const char*>(&header), sizeof header);
    for (const std::span<const std::byte>& part : parts)
        file_.write(reinterpret_cast<const char*>(part.data()), std::streamsize(part.size()));
    file_.flush();
}

}  // namespace daylit
