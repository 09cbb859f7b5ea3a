// From bytes to tinygltf's model. tinygltf decodes JSON, data URIs and buffers; files are opened by us, and images are
// kept encoded for OpenImageIO.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/base/file.h"
#include "engine/scene/gltf_file.h"

namespace daylit::gltf {
namespace {

// tinygltf counts bytes of images in an int.
constexpr std::size_t kMaxFileBytes = std::size_t(0x7fffffff);

constexpr std::array<const char*, 11> kSupported = {"KHR_lights_punctual",
                                                    "KHR_materials_emissive_strength",
                                                    "KHR_materials_unlit",
                                                    "KHR_materials_ior",
                                                    "KHR_materials_transmission",
                                                    "KHR_materials_specular",
                                                    "KHR_materials_pbrSpecularGlossiness",
                                                    "KHR_mesh_quantization",
                                                    "KHR_texture_transform",
                                                    "EXT_mesh_gpu_instancing",
                                                    "EXT_texture_webp"};

bool file_exists(const std::string& path, void*) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

std::string same_path(const std::string& path, void*) {
    return path;
}

bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& path, void*) {
    try {
        *out = read_file(path, kMaxFileBytes);
        return true;
    } catch (const Error& failure) {
        if (error) *error += failure.what();
        return false;
    }
}

bool keep_image_bytes(tinygltf::Image*, const int index, std::string*, std::string*, int, int,
                      const unsigned char* bytes, int size, void* images) {
    auto& kept = *static_cast<std::vector<std::vector<std::uint8_t>>*>(images);
    if (kept.size() <= std::size_t(index)) kept.resize(std::size_t(index) + 1);
    if (size > 0) kept[std::size_t(index)].assign(bytes, bytes + size);
    return true;
}

void note_ignored_extensions(File& file) {
    std::vector<std::string> named = file.model.extensionsUsed;
    std::sort(named.begin(), named.end());
    named.erase(std::unique(named.begin(), named.end()), named.end());
    for (const std::string& extension : named)
        if (!is_supported(extension)) file.note("extension " + extension, "is optional and ignored");
}

}  // namespace

bool is_supported(const std::string& extension) {
    return std::any_of(kSupported.begin(), kSupported.end(), [&](const char* name) { return extension == name; });
}

float File::number(double value, const std::string& where) const {
    const float number = float(value);
    if (!std::isfinite(number)) fail(where, "is not a finite number");
    return number;
}

bool File::uses(const std::string& extension) const {
    return std::find(model.extensionsUsed.begin(), model.extensionsUsed.end(), extension) != model.extensionsUsed.end();
}

std::string place(const char* kind, std::size_t index, const std::string& name) {
    std::string text = std::string(kind) + " " + std::to_string(index);
    return name.empty() ? text : text + " '" + name + "'";
}

File open(const std::filesystem::path& path) {
    File file;
    file.path = path;
    const std::vector<std::uint8_t> bytes = read_file(path, kMaxFileBytes);
    const Document document = check_document(bytes, file);

    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({&file_exists, &same_path, &read_whole_file, nullptr, nullptr});
    parser.SetImageLoader(&keep_image_bytes, &file.image_bytes);
    std::string error, warning;
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    const bool read =
        document.binary
            ? parser.LoadBinaryFromMemory(&file.model, &error, &warning, bytes.data(), unsigned(bytes.size()), folder)
            : parser.LoadASCIIFromString(&file.model, &error, &warning, reinterpret_cast<const char*>(bytes.data()),
                                         unsigned(bytes.size()), folder);
    if (!read) throw Error(path.string(), error.empty() ? "is not glTF" : one_line(error));
    file.image_bytes.resize(file.model.images.size());
    for (const tinygltf::Buffer& buffer : file.model.buffers) file.buffer_bytes += buffer.data.size();
    note_ignored_extensions(file);
    return file;
}

}  // namespace daylit::gltf
