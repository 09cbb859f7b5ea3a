#pragma once
// The readers take paths; a fuzzer has bytes.
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>

namespace daylit::fuzz {

/// A file of this process in memory, written anew for each input.
inline const std::string& file_with(std::span<const std::uint8_t> bytes, const char* extension) {
    static const std::string path = "/dev/shm/daylit-fuzz-" + std::to_string(getpid()) + extension;
    [[maybe_unused]] static const int registered = std::atexit([] { std::remove(path.c_str()); });
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file || std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() || std::fclose(file) != 0)
        std::abort();
    return path;
}

}  // namespace daylit::fuzz
