#include "engine/base/png_check.h"

#include <array>
#include <cstring>

namespace daylit {
namespace {

constexpr std::size_t kSignatureBytes = 8, kChunkFrameBytes = 12;  // length, type and check sum of a chunk

/// CRC-32 of ISO 3309, reflected polynomial 0xEDB88320 (PNG specification, annex D).
constexpr std::array<std::uint32_t, 256> crc_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t c = i;
        for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
        table[i] = c;
    }
    return table;
}

std::uint32_t crc(std::span<const std::uint8_t> bytes) {
    static constexpr std::array<std::uint32_t, 256> kTable = crc_table();
    std::uint32_t c = 0xFFFFFFFFu;
    for (const std::uint8_t byte : bytes) c = kTable[(c ^ byte) & 0xFF] ^ (c >> 8);
    return ~c;
}

std::uint32_t big_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
    return std::uint32_t(bytes[at]) << 24 | std::uint32_t(bytes[at + 1]) << 16 | std::uint32_t(bytes[at + 2]) << 8 |
           std::uint32_t(bytes[at + 3]);
}

}  // namespace

std::string png_damage(std::span<const std::uint8_t> bytes) {
    bool pixels = false;
    for (std::size_t at = kSignatureBytes; at < bytes.size();) {
        if (bytes.size() - at < kChunkFrameBytes) return "is cut off";
        const std::size_t length = big_endian(bytes, at);
        if (length > bytes.size() - at - kChunkFrameBytes) return "is cut off or says a wrong length";
        const auto type_and_data = bytes.subspan(at + 4, 4 + length);
        if (crc(type_and_data) != big_endian(bytes, at + 8 + length)) return "is damaged: a check sum does not match";
        const auto is = [&](const char* type) { return std::memcmp(type_and_data.data(), type, 4) == 0; };
        if (at == kSignatureBytes && (!is("IHDR") || length != 13)) return "does not start with its size";
        pixels |= is("IDAT");
        if (is("IEND")) return pixels ? "" : "holds no pixels";
        at += kChunkFrameBytes + length;
    }
    return "is cut off";
}

}  // namespace daylit
