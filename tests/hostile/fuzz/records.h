#pragma once
// A .daylit file without its compression and check sums, which no fuzzer gets past: records of a name, a length and
// bytes, of which a whole file is made again.
#include <span>

#include "engine/baked/section_file.h"

namespace daylit::fuzz {

inline Bytes to_records(const std::filesystem::path& baked) {
    const SectionFile file(baked);
    ByteWriter writer;
    for (const SectionEntry& entry : file.sections()) {
        writer.put(entry.name);
        writer.put(std::uint32_t(entry.decoded));
        const std::string_view name(entry.name.data(), entry.name.size());
        writer.put_all(file.open(name, std::size_t(entry.decoded)).get_all<std::uint8_t>(std::size_t(entry.decoded)));
    }
    return writer.take();
}

/// What comes after the last whole record is its payload, cut off.
inline std::vector<CodedSection> from_records(std::span<const std::uint8_t> bytes) {
    std::vector<CodedSection> sections;
    while (bytes.size() >= 8) {
        char name[5] = {};
        std::uint32_t length = 0;
        std::memcpy(name, bytes.data(), 4);
        std::memcpy(&length, bytes.data() + 4, 4);
        bytes = bytes.subspan(8);
        const std::size_t size = std::min<std::size_t>(length, bytes.size());
        sections.push_back(code_section(name, Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(size))));
        bytes = bytes.subspan(size);
    }
    return sections;
}

}  // namespace daylit::fuzz
