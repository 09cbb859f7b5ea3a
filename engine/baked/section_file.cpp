// Layout: FORMAT.md. Sizes and checksums are checked before memory is taken or a number believed.
#include "engine/baked/section_file.h"

#include <xxhash.h>
#include <zstd.h>

#include <fstream>
#include <memory>

#include "engine/base/file.h"

namespace daylit {
namespace {

using Path = std::filesystem::path;

constexpr std::array<char, 8> kMagic = {'D', 'A', 'Y', 'L', 'I', 'T', '\r', '\n'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderBytes = 32, kEntryBytes = 48;
constexpr std::uint32_t kMaxSections = 64;
constexpr std::uint64_t kMaxSectionBytes = std::uint64_t(1) << 30;
constexpr int kZstdLevel = 6;
static_assert(sizeof(SectionEntry) == kEntryBytes);

std::string quoted(const SectionEntry& section) {
    return "section '" + std::string(section.name.begin(), section.name.end()) + "'";
}

/// head   the header and the table
std::uint64_t head_hash(std::span<const std::uint8_t> head) {
    const std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state(XXH64_createState(), XXH64_freeState);
    XXH64_reset(state.get(), 0);
    XXH64_update(state.get(), head.data(), 24);
    XXH64_update(state.get(), head.data() + kHeaderBytes, head.size() - kHeaderBytes);
    return XXH64_digest(state.get());
}

template <class T>
T load(std::span<const std::uint8_t> bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

[[noreturn]] void refuse(const Path& path, const std::string& what) {
    throw Error(path.string(), what + "; bake the scene again");
}

/// A stretch of the file; shorter where the file ends.
Bytes read_stretch(const Path& path, std::uint64_t offset, std::size_t length) {
    std::ifstream file(path, std::ios::binary);
    Bytes bytes(length);
    file.seekg(std::streamoff(offset));
    file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(length));
    bytes.resize(std::size_t(std::max<std::streamsize>(file.gcount(), 0)));
    return bytes;
}

std::uint64_t size_of(const Path& path) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) read_file(path, 0);  // says what is wrong with it
    return std::filesystem::file_size(path);
}

}  // namespace

CodedSection code_section(const char (&name)[5], const Bytes& raw) {
    CodedSection section;
    std::memcpy(section.entry.name.data(), name, 4);
    section.entry.coding = 1;
    section.entry.decoded = raw.size();
    section.stored.resize(ZSTD_compressBound(raw.size()));
    const std::size_t size =
        ZSTD_compress(section.stored.data(), section.stored.size(), raw.data(), raw.size(), kZstdLevel);
    if (ZSTD_isError(size)) throw Error(std::string("cannot compress a section: ") + ZSTD_getErrorName(size));
    section.stored.resize(size);
    section.entry.stored = size;
    section.entry.hash = XXH64(section.stored.data(), size, 0);
    return section;
}

void write_sections(const Path& path, std::vector<CodedSection> sections) {
    std::uint64_t end = kHeaderBytes + kEntryBytes * sections.size();
    for (CodedSection& s : sections) {
        s.entry.offset = end;
        end += s.entry.stored;
    }
    ByteWriter w;
    w.put(kMagic), w.put(kVersion), w.put(std::uint32_t(sections.size())), w.put(end), w.put(std::uint64_t(0));
    for (const CodedSection& s : sections) w.put(s.entry);
    Bytes file = w.take();
    const std::uint64_t hash = head_hash(file);
    std::memcpy(file.data() + 24, &hash, sizeof hash);
    for (const CodedSection& s : sections) file.insert(file.end(), s.stored.begin(), s.stored.end());
    write_file(path, file);
}

SectionFile::SectionFile(const Path& path) : path_(path) {
    const std::uint64_t size = size_of(path);
    const Bytes header = read_stretch(path, 0, kHeaderBytes);
    if (header.size() < kHeaderBytes || load<std::array<char, 8>>(header, 0) != kMagic)
        refuse(path, "is not a .daylit file");
    const auto version = load<std::uint32_t>(header, 8), count = load<std::uint32_t>(header, 12);
    if (version != kVersion)
        refuse(path, "has version " + std::to_string(version) + " of the format, this program reads " +
                         std::to_string(kVersion));
    if (load<std::uint64_t>(header, 16) != size)
        refuse(path, "is " + std::to_string(size) + " bytes long, its header says " +
                         std::to_string(load<std::uint64_t>(header, 16)));
    const std::size_t head_bytes = kHeaderBytes + kEntryBytes * std::size_t(count);
    if (count > kMaxSections || size < head_bytes) refuse(path, "has a damaged header");
    const Bytes head = read_stretch(path, 0, head_bytes);
    if (head.size() != head_bytes || load<std::uint64_t>(head, 24) != head_hash(head))
        refuse(path, "has a damaged header");

    std::uint64_t end = head_bytes;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto s = load<SectionEntry>(head, kHeaderBytes + kEntryBytes * i);
        if (s.offset != end || s.stored > size - end) refuse(path, quoted(s) + " lies outside the file");
        if (s.coding > 1 || s.decoded > kMaxSectionBytes || (s.coding == 0 && s.decoded != s.stored))
            refuse(path, quoted(s) + " is coded in an unknown way");
        end += s.stored;
        sections_.push_back(s);
    }
    if (end != size) refuse(path, "has bytes after its last section");
}

const SectionEntry* SectionFile::find(std::string_view name) const {
    for (const SectionEntry& s : sections_)
        if (name == std::string_view(s.name.data(), s.name.size())) return &s;
    return nullptr;
}

ByteReader SectionFile::open(std::string_view name, std::size_t most) const {
    const SectionEntry* section = find(name);
    if (!section) refuse(path_, "has no section '" + std::string(name) + "'");
    if (section->decoded > most) refuse(path_, quoted(*section) + " is too large");
    Bytes stored = read_stretch(path_, section->offset, section->stored);
    const auto check = [&](bool good) {
        if (!good) refuse(path_, quoted(*section) + " is damaged");
    };
    check(stored.size() == section->stored && XXH64(stored.data(), stored.size(), 0) == section->hash);
    if (section->coding == 0) return {std::move(stored), path_, quoted(*section)};
    check(ZSTD_getFrameContentSize(stored.data(), stored.size()) == section->decoded);
    Bytes raw(section->decoded);
    const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size());
    check(!ZSTD_isError(size) && size == raw.size());
    return {std::move(raw), path_, quoted(*section)};
}

}  // namespace daylit
