#include "tests/support/gltf_builder.h"

#include <unistd.h>

namespace daylit::test {
namespace {

void append_word(std::vector<std::uint8_t>& bytes, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(std::uint8_t(word >> shift));
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("daylit-test-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
    std::filesystem::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::filesystem::path GltfBuilder::save_gltf(const std::filesystem::path& path) const {
    Json whole = json;
    if (!bytes.empty())
        whole["buffers"] = {
            {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
    write_file(path, whole.dump());
    return path;
}

std::vector<std::uint8_t> GltfBuilder::glb() const {
    Json whole = json;
    if (!bytes.empty()) whole["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::uint8_t> data = bytes;
    data.resize((data.size() + 3) / 4 * 4, 0);
    std::vector<std::uint8_t> out = {'g', 'l', 'T', 'F'};
    append_word(out, 2);
    append_word(out, 12 + 8 + text.size() + (data.empty() ? 0 : 8 + data.size()));
    append_word(out, text.size());
    append_word(out, 0x4E4F534A);
    out.insert(out.end(), text.begin(), text.end());
    if (data.empty()) return out;
    append_word(out, data.size());
    append_word(out, 0x004E4942);
    out.insert(out.end(), data.begin(), data.end());
    return out;
}

std::filesystem::path GltfBuilder::save_glb(const std::filesystem::path& path) const {
    write_file(path, glb());
    return path;
}

GltfBuilder triangle() {
    GltfBuilder builder;
    const int positions = builder.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    builder.place_primitive({{"attributes", {{"POSITION", positions}}}});
    return builder;
}

}  // namespace daylit::test
