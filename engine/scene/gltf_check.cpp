#include "engine/scene/gltf_file.h"

namespace daylit::gltf {

Document check_document(std::span<const std::uint8_t> bytes, File& file) {
    if (bytes.empty()) throw Error(file.path.string(), "is an empty file");
    Document document;
    document.binary = bytes.size() >= 4 && std::equal(bytes.begin(), bytes.begin() + 4, "glTF");
    return document;
}

}  // namespace daylit::gltf
