#pragma once
// Small glTF files for tests: JSON as nlohmann::json, data in one buffer, written as .gltf (data URI) or .glb.
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/file.h"

namespace daylit::test {

using Json = nlohmann::json;

/// A folder of its own for each process, removed at the end.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

std::string base64(const std::vector<std::uint8_t>& bytes);

struct GltfBuilder {
    Json json = {{"asset", {{"version", "2.0"}}}};
    std::vector<std::uint8_t> bytes;

    /// Appends values (aligned to 4) as a view and an accessor; returns the accessor's index.
    template <typename T>
    int accessor(const std::string& type, int component_type, const std::vector<T>& values, bool normalized = false) {
        static const std::map<std::string, std::size_t> kComponents = {
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
        Json accessor = {{"bufferView", view(values)},
                         {"componentType", component_type},
                         {"count", values.size() / kComponents.at(type)},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        json["accessors"].push_back(accessor);
        return int(json["accessors"].size()) - 1;
    }
    int floats(const std::string& type, const std::vector<float>& values) { return accessor(type, 5126, values); }
    int indices(const std::vector<std::uint16_t>& values) { return accessor("SCALAR", 5123, values); }

    template <typename T>
    int view(const std::vector<T>& values) {
        while (bytes.size() % 4 != 0) bytes.push_back(0);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(T)}});
        const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
        bytes.insert(bytes.end(), first, first + values.size() * sizeof(T));
        return int(json["bufferViews"].size()) - 1;
    }

    /// One node with one mesh of one primitive in the scene.
    void place_primitive(const Json& primitive) {
        json["meshes"].push_back({{"primitives", {primitive}}});
        json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
        json["scenes"] = {{{"nodes", {0}}}};
    }

    std::filesystem::path save_gltf(const std::filesystem::path& path) const;
    std::filesystem::path save_glb(const std::filesystem::path& path) const;
    std::vector<std::uint8_t> glb() const;
};

/// A unit right triangle (0,0,0), (1,0,0), (0,1,0) with nothing but positions, not indexed.
GltfBuilder triangle();

}  // namespace daylit::test
