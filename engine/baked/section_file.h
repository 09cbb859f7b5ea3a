#pragma once
// The container of a .daylit file: a checked table of named, compressed, checksummed sections (FORMAT.md). What the
// sections mean is known by those who code them.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine/baked/bytes.h"

namespace daylit {

/// A section as it stands in the table, byte for byte.
struct SectionEntry {
    std::array<char, 4> name;
    std::uint32_t coding = 0;
    std::uint64_t offset = 0, stored = 0, decoded = 0, hash = 0, zero = 0;
};

/// A section ready to be written.
struct CodedSection {
    SectionEntry entry;
    Bytes stored;
};
CodedSection code_section(const char (&name)[5], const Bytes& raw);

/// Writes the file whole, sections in this order.
void write_sections(const std::filesystem::path& path, std::vector<CodedSection> sections);

/// Reads the table at once and sections when they are opened.
class SectionFile {
  public:
    /// throws Error for damaged, truncated, foreign or newer files.
    explicit SectionFile(const std::filesystem::path& path);

    bool has(std::string_view name) const { return find(name) != nullptr; }
    const std::vector<SectionEntry>& sections() const { return sections_; }
    /// The checked and decoded bytes of a section. throws Error when it is absent, damaged, or larger than `most`.
    ByteReader open(std::string_view name, std::size_t most = kSmallSection) const;

    static constexpr std::size_t kSmallSection = std::size_t(32) << 20;  // of settings, plan and the like

  private:
    const SectionEntry* find(std::string_view name) const;

    std::filesystem::path path_;
    std::vector<SectionEntry> sections_;
};

}  // namespace daylit
