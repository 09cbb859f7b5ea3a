#pragma once
// A glTF file between parsing and Scene: tinygltf's model, the images' encoded bytes, and what the converters of
// gltf_*.cpp share. Only those files include this one.
#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/scene/scene.h"

namespace daylit::gltf {

/// A specular-glossiness material whose texture is to become a roughness texture once it is decoded.
struct GlossyMaterial {
    std::size_t material;
    float glossiness;  // factor of the texture's alpha
};

struct File {
    std::filesystem::path path;
    tinygltf::Model model;
    std::vector<std::vector<std::uint8_t>> image_bytes;  // one per model.images; empty when it could not be found
    float unit = 1.0f;                                   // metres per file unit
    bool lambert = false;
    std::vector<std::string> notes;
    std::vector<GlossyMaterial> glossy;
    std::vector<bool> used_accessors;  // that check_accessor has seen
    std::uint64_t decoded_bytes = 0;   // charged so far
    std::uint64_t buffer_bytes = 0;    // of all buffers together

    [[noreturn]] void fail(const std::string& place, const std::string& message) const {
        throw Error(path.string(), one_line(place + " " + message));
    }
    void note(const std::string& place, const std::string& message) {
        notes.push_back(one_line(place + " " + message));
    }

    /// Counts memory about to be taken for decoded data; fails when it is out of proportion to the file.
    void charge(std::uint64_t bytes, const std::string& place);
    /// A JSON number as a float; fails when it is beyond a float's range.
    float number(double value, const std::string& place) const;
    bool uses(const std::string& extension) const;
};

/// "node 3 'door'", for messages.
std::string place(const char* kind, std::size_t index, const std::string& name = {});

template <typename T>
bool in_range(int index, const std::vector<T>& vector) {
    return index >= 0 && std::size_t(index) < vector.size();
}

// --- gltf_check.cpp: what tinygltf takes on trust. GLB framing, JSON types and required properties, sizes of buffers
// and of image views. Fails for what cannot be read safely, notes what is only odd.
bool is_supported(const std::string& extension);
struct Document {
    bool binary = false;
};
Document check_document(std::span<const std::uint8_t> bytes, File& file);

// --- gltf_document.cpp: bytes to File. Framing, JSON types, buffers; refuses unsupported required extensions.
File open(const std::filesystem::path& path);

// --- gltf_accessor.cpp: every read is checked against the buffer first, in 64-bit arithmetic that cannot overflow.
struct AccessorShape {
    std::size_t count = 0;
    int components = 0;      // 1 to 16
    int component_type = 0;  // TINYGLTF_COMPONENT_TYPE_*
    bool normalized = false;
};
/// Checks everything that the accessor declares: views, buffers, strides, alignment, sparse parts, decoded size.
AccessorShape check_accessor(File& file, int accessor, const std::string& place);

/// Elements as floats, components side by side: all of them, or those named by `elements` (each below count, in any
/// order). Integers are converted by glTF's rules when normalised, else as they are. Fails on NaN and infinity.
std::vector<float> read_floats(File& file, int accessor, const std::string& place);
std::vector<float> read_floats(File& file, int accessor, std::span<const std::uint32_t> elements,
                               const std::string& place);
/// Elements of an integer accessor, components side by side.
std::vector<std::uint32_t> read_integers(File& file, int accessor, const std::string& place);
std::vector<std::uint32_t> read_integers(File& file, int accessor, std::span<const std::uint32_t> elements,
                                         const std::string& place);

/// Regroups a flat array.
template <typename Vector>
std::vector<Vector> grouped(const std::vector<float>& flat) {
    constexpr int n = Vector::length();
    std::vector<Vector> vectors(flat.size() / n);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        for (int c = 0; c < n; ++c) vectors[i][c] = flat[i * n + std::size_t(c)];
    return vectors;
}

// --- gltf_material.cpp, gltf_image.cpp
void read_materials(File& file, Scene& scene);
/// Reads the images that materials use (in parallel) and renumbers textures and images to those.
void read_textures(File& file, Scene& scene);

// --- gltf_mesh.cpp
void read_meshes(File& file, Scene& scene);
/// The file's vertex at each corner of the triangles that read_meshes makes of a primitive; none of other primitives.
std::vector<std::uint32_t> triangle_corners(File& file, const tinygltf::Primitive& primitive, const std::string& place);

// --- gltf_node.cpp: the tree, cameras, lights, skins, instances, extras.daylit
SceneExtras read_extras(File& file);
/// The object extras.daylit; null when there is none.
const tinygltf::Value* daylit_extras(const tinygltf::Value& extras);
/// Of a material or a light; a word that daylit does not know is noted.
Lit read_lit(File& file, const tinygltf::Value& extras, const std::string& where);
void read_nodes(File& file, Scene& scene);
/// What only the whole scene shows: joints against skins, placed sizes, dynamic nodes, accessors of no use.
void check_placement(File& file, Scene& scene);

// --- gltf_animation.cpp
void read_animations(File& file, Scene& scene);

}  // namespace daylit::gltf
