// Primitives to indexed triangle or point lists with every attribute that the rest of daylit expects.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/vec.h"
#include "engine/scene/gltf_file.h"
#include "engine/scene/tangents.h"

namespace daylit::gltf {
namespace {

constexpr int kMaxUvSets = 8;

using Indices = std::vector<std::uint32_t>;

/// One primitive on its way in.
struct Source {
    File& file;
    const tinygltf::Primitive& in;
    std::string place;
    std::size_t vertices = 0;  // in the file
    Indices elements;          // the file's vertices that are kept, in the order of the result
    int accessor(const std::string& attribute) const {
        const auto found = in.attributes.find(attribute);
        return found == in.attributes.end() ? -1 : found->second;
    }
};

bool is_float(const AccessorShape& shape) {
    return shape.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT;
}
bool is_signed(const AccessorShape& shape) {
    return shape.component_type == TINYGLTF_COMPONENT_TYPE_BYTE ||
           shape.component_type == TINYGLTF_COMPONENT_TYPE_SHORT;
}
bool is_short_unsigned(const AccessorShape& shape) {
    return shape.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           shape.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

enum class Format { Position, Direction, Uv, Color, Weight };

/// Section 3.7.2.1, and KHR_mesh_quantization where the file uses it.
bool allowed(const File& file, const AccessorShape& shape, Format format) {
    if (is_float(shape)) return true;
    const bool quantized = file.uses("KHR_mesh_quantization");
    switch (format) {
        case Format::Position:
            return quantized && (is_signed(shape) || is_short_unsigned(shape));
        case Format::Direction:
            return quantized && is_signed(shape) && shape.normalized;
        case Format::Uv:
            return is_short_unsigned(shape) ? shape.normalized || quantized : quantized && is_signed(shape);
        case Format::Color:
        case Format::Weight:
            return is_short_unsigned(shape) && shape.normalized;
    }
    return false;
}

AccessorShape checked_attribute(const Source& source, int accessor, Format format, int fewest, int most,
                                const std::string& where) {
    const AccessorShape shape = check_accessor(source.file, accessor, where);
    if (shape.components < fewest || shape.components > most || !allowed(source.file, shape, format))
        source.file.fail(where, "has a type that glTF does not allow there");
    if (shape.count != source.vertices)
        source.file.fail(where, "has " + std::to_string(shape.count) + " elements for " +
                                    std::to_string(source.vertices) + " positions");
    return shape;
}

std::vector<float> read_attribute(const Source& source, int accessor, Format format, int components,
                                  const std::string& name) {
    const std::string where = source.place + " " + name;
    checked_attribute(source, accessor, format, components, components, where);
    return read_floats(source.file, accessor, source.elements, where);
}

/// Of its component type; to OpenGL it may mean primitive restart.
std::uint32_t largest_index(const AccessorShape& shape) {
    switch (shape.component_type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 0xff;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 0xffff;
        default:
            return 0xffffffff;
    }
}

Indices read_indices(Source& source) {
    if (source.in.indices == -1) {
        source.file.charge(source.vertices * sizeof(std::uint32_t), source.place);
        Indices all(source.vertices);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    const std::string where = source.place + " indices";
    const AccessorShape shape = check_accessor(source.file, source.in.indices, where);
    if (shape.components != 1) source.file.fail(where, "must be scalars");
    const std::uint32_t restart = largest_index(shape);
    Indices indices = read_integers(source.file, source.in.indices, where);
    for (const std::uint32_t index : indices) {
        if (index >= source.vertices)
            source.file.fail(where,
                             "refer to vertex " + std::to_string(index) + " of " + std::to_string(source.vertices));
        if (index == restart) source.file.fail(where, "use the primitive restart value, which glTF forbids");
    }
    return indices;
}

/// Section 3.7.2.1: strips turn every second triangle round; fans share their first vertex.
Indices triangle_list(Source& source, const Indices& indices) {
    const std::size_t n = indices.size();
    Indices list;
    if (source.in.mode == TINYGLTF_MODE_TRIANGLES) {
        if (n % 3 != 0)
            source.file.note(source.place, "has a vertex count that is no multiple of 3; the rest is dropped");
        list.assign(indices.begin(), indices.begin() + std::ptrdiff_t(n - n % 3));
        return list;
    }
    for (std::size_t i = 0; i + 2 < n; ++i) {
        const bool strip = source.in.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const std::size_t a = strip ? i : 0, b = i + 1, c = i + 2;
        const bool turned = strip && i % 2 == 1;
        list.insert(list.end(), {indices[a], indices[turned ? c : b], indices[turned ? b : c]});
    }
    return list;
}

/// Numbers the vertices that are used, in the file's order; `indices` then refer to those.
Indices keep_used(Indices& indices, std::size_t vertices) {
    Indices number(vertices, 0);
    for (const std::uint32_t index : indices) number[index] = 1;
    Indices used;
    for (std::size_t v = 0; v < vertices; ++v)
        if (number[v]) {
            number[v] = std::uint32_t(used.size());
            used.push_back(std::uint32_t(v));
        }
    for (std::uint32_t& index : indices) index = number[index];
    return used;
}

Vec3 face_normal(const Primitive& primitive, std::size_t triangle) {
    const auto corner = [&](std::size_t i) {
        return glm::dvec3(primitive.positions[primitive.indices[3 * triangle + i]]);
    };
    const glm::dvec3 n = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    const double length = glm::length(n);
    return length > 0 ? Vec3(n / length) : Vec3(0, 1, 0);
}

/// Each triangle has its own vertices here.
void make_flat_normals(Primitive& primitive) {
    primitive.normals.resize(primitive.positions.size());
    for (std::size_t t = 0; t < primitive.indices.size() / 3; ++t) {
        const Vec3 n = face_normal(primitive, t);
        for (std::size_t i = 0; i < 3; ++i) primitive.normals[primitive.indices[3 * t + i]] = n;
    }
}

/// Unit length; a zero normal becomes that of one of its triangles.
void repair_normals(const Source& source, Primitive& primitive) {
    std::size_t broken = 0;
    for (Vec3& normal : primitive.normals) {
        normal = unit_or(normal, Vec3(0.0f));
        broken += normal == Vec3(0.0f);
    }
    if (broken == 0) return;
    source.file.note(source.place, "has " + std::to_string(broken) + " normals of no length; made from its triangles");
    if (primitive.topology == Topology::Triangles)
        for (std::size_t i = 0; i < primitive.indices.size(); ++i)
            if (Vec3& normal = primitive.normals[primitive.indices[i]]; normal == Vec3(0.0f))
                normal = face_normal(primitive, i / 3);
    for (Vec3& normal : primitive.normals)
        if (normal == Vec3(0.0f)) normal = Vec3(0, 1, 0);
}

void read_normals(const Source& source, Primitive& out) {
    const int accessor = source.accessor("NORMAL");
    if (accessor >= 0) {
        out.normals = grouped<Vec3>(read_attribute(source, accessor, Format::Direction, 3, "NORMAL"));
        repair_normals(source, out);
    } else if (out.topology == Topology::Triangles) {
        make_flat_normals(out);
    } else {
        out.normals.assign(out.positions.size(), Vec3(0, 1, 0));
    }
}

void read_uvs(const Source& source, Primitive& out) {
    for (int set = 0; set < kMaxUvSets; ++set) {
        const std::string name = "TEXCOORD_" + std::to_string(set);
        const int accessor = source.accessor(name);
        if (accessor < 0) return;
        out.uvs.push_back(grouped<Vec2>(read_attribute(source, accessor, Format::Uv, 2, name)));
    }
}

void read_colors(const Source& source, Primitive& out) {
    const int accessor = source.accessor("COLOR_0");
    if (accessor < 0) return;
    const std::string where = source.place + " COLOR_0";
    const std::size_t n = std::size_t(checked_attribute(source, accessor, Format::Color, 3, 4, where).components);
    const std::vector<float> values = read_floats(source.file, accessor, source.elements, where);
    out.colors.assign(values.size() / n, Rgba(1.0f));
    for (std::size_t i = 0; i < values.size(); ++i) out.colors[i / n][int(i % n)] = std::clamp(values[i], 0.0f, 1.0f);
}

Vec4 normalized_weights(Vec4 weights) {
    weights = glm::max(weights, Vec4(0.0f));
    const float sum = weights.x + weights.y + weights.z + weights.w;
    return sum > 0 && std::isfinite(sum) ? weights / sum : Vec4(1, 0, 0, 0);
}

void read_skinning(const Source& source, Primitive& out) {
    const int joints = source.accessor("JOINTS_0"), weights = source.accessor("WEIGHTS_0");
    if (joints < 0 && weights < 0) return;
    if (joints < 0 || weights < 0)
        return source.file.note(source.place, "has joints without weights or weights without joints; not skinned");
    if (source.accessor("JOINTS_1") >= 0)
        source.file.note(source.place, "has more than 4 joints a vertex; the first 4 count");
    const std::string where = source.place + " JOINTS_0";
    const AccessorShape shape = check_accessor(source.file, joints, where);
    if (shape.components != 4 || !is_short_unsigned(shape) || shape.count != source.vertices)
        source.file.fail(where, "must be one vector of 4 unsigned bytes or shorts for every position");
    const Indices numbers = read_integers(source.file, joints, source.elements, where);
    out.weights = grouped<Vec4>(read_attribute(source, weights, Format::Weight, 4, "WEIGHTS_0"));
    out.joints.resize(out.weights.size());
    for (std::size_t v = 0; v < out.joints.size(); ++v) {
        out.weights[v] = normalized_weights(out.weights[v]);
        for (std::size_t i = 0; i < 4; ++i)  // a joint of no weight may be any number in the file
            out.joints[v][i] = out.weights[v][int(i)] > 0 ? std::uint16_t(numbers[4 * v + i]) : std::uint16_t(0);
    }
}

void read_morph_targets(const Source& source, Primitive& out) {
    for (std::size_t t = 0; t < source.in.targets.size(); ++t) {
        MorphTarget target;
        for (const auto& [name, accessor] : source.in.targets[t]) {
            std::vector<Vec3>* into = name == "POSITION"  ? &target.positions
                                      : name == "NORMAL"  ? &target.normals
                                      : name == "TANGENT" ? &target.tangents
                                                          : nullptr;
            const std::string label = "morph target " + std::to_string(t) + " " + name;
            if (!into) {
                source.file.note(source.place, label + " is ignored");
                continue;
            }
            const Format format = name == "POSITION" ? Format::Position : Format::Direction;
            *into = grouped<Vec3>(read_attribute(source, accessor, format, 3, label));
        }
        for (Vec3& position : target.positions) position *= source.file.unit;
        out.morph_targets.push_back(std::move(target));
    }
}

/// Tangents serve normal maps only.
void read_tangents(const Source& source, const Material& material, Primitive& out) {
    if (material.normal_texture.texture < 0 || out.topology == Topology::Points) return;
    const int accessor = source.accessor("TANGENT");
    // Tangents belong to the file's normals; where those were made, the tangents are made too.
    if (accessor < 0 || source.accessor("NORMAL") < 0) return make_tangents(out, material.normal_texture.uv_set);
    out.tangents = grouped<Vec4>(read_attribute(source, accessor, Format::Direction, 4, "TANGENT"));
    for (std::size_t v = 0; v < out.tangents.size(); ++v) {
        const Vec3 t = unit_or(Vec3(out.tangents[v]), any_tangent(out.normals[v]));
        out.tangents[v] = Vec4(t, out.tangents[v].w < 0 ? -1.0f : 1.0f);
    }
}

void note_ignored(const Source& source, const Material& material, const Primitive& out) {
    for (const auto& [name, accessor] : source.in.attributes) {
        static constexpr std::array<const char*, 4> kKnown = {"POSITION", "NORMAL", "TANGENT", "COLOR_0"};
        const bool known = std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end() ||
                           name.starts_with("TEXCOORD_") || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
        if (!known && !name.starts_with("_")) source.file.note(source.place, "attribute " + name + " is ignored");
        check_accessor(source.file, accessor, source.place + " " + name);
    }
    for (const TextureRef* ref : material.textures())
        if (ref->texture >= 0 && std::size_t(ref->uv_set) >= out.uvs.size()) {
            source.file.note(source.place, "has no TEXCOORD_" + std::to_string(ref->uv_set) +
                                               ", which its material's textures need; (0, 0) is taken");
            return;
        }
}

/// False when there is nothing to draw.
bool read_topology(Source& source, Primitive& out) {
    const int mode = source.in.mode;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN)
        source.file.fail(source.place, "has the unknown mode " + std::to_string(mode));
    if (source.accessor("POSITION") < 0) {
        source.file.note(source.place, "has no POSITION; dropped");
        return false;
    }
    const std::string where = source.place + " POSITION";
    source.vertices = check_accessor(source.file, source.accessor("POSITION"), where).count;
    Indices indices = read_indices(source);
    if (mode == TINYGLTF_MODE_LINE || mode == TINYGLTF_MODE_LINE_LOOP || mode == TINYGLTF_MODE_LINE_STRIP) {
        source.file.note(source.place, "is made of lines; dropped");
        return false;
    }
    out.topology = mode == TINYGLTF_MODE_POINTS ? Topology::Points : Topology::Triangles;
    if (out.topology == Topology::Triangles) indices = triangle_list(source, indices);
    if (indices.empty()) {
        source.file.note(source.place, "has no whole triangle; dropped");
        return false;
    }
    if (out.topology == Topology::Triangles && source.accessor("NORMAL") < 0) {
        // Flat normals: every corner its own vertex.
        source.file.charge(2 * indices.size() * sizeof(std::uint32_t), source.place);
        source.elements = std::move(indices);
        out.indices.resize(source.elements.size());
        std::iota(out.indices.begin(), out.indices.end(), 0u);
    } else {
        // Scratch memory in proportion to the declared vertices, which a zero-filled accessor makes up freely.
        source.file.charge(source.vertices, source.place);
        source.elements = keep_used(indices, source.vertices);
        out.indices = std::move(indices);
    }
    return true;
}

int material_of(File& file, const Scene& scene, int material, const std::string& where) {
    if (material == -1) return int(scene.materials.size()) - 1;
    if (!in_range(material, file.model.materials))
        file.fail(where, "refers to material " + std::to_string(material) + ", which does not exist");
    return material;
}

bool read_primitive(File& file, const Scene& scene, const tinygltf::Primitive& in, const std::string& where,
                    Primitive& out) {
    Source source{file, in, where, 0, {}};
    out.material = material_of(file, scene, in.material, where);
    if (!read_topology(source, out)) return false;
    const Material& material = scene.materials[std::size_t(out.material)];
    out.positions = grouped<Vec3>(read_attribute(source, source.accessor("POSITION"), Format::Position, 3, "POSITION"));
    for (Vec3& position : out.positions) position *= file.unit;
    read_normals(source, out);
    read_uvs(source, out);
    read_colors(source, out);
    read_skinning(source, out);
    read_morph_targets(source, out);
    read_tangents(source, material, out);
    note_ignored(source, material, out);
    return true;
}

/// Primitives of one mesh share one set of weights.
void even_out_morph_targets(File& file, const tinygltf::Mesh& in, Mesh& mesh, const std::string& where) {
    std::size_t most = 0;
    for (const Primitive& primitive : mesh.primitives) most = std::max(most, primitive.morph_targets.size());
    for (Primitive& primitive : mesh.primitives) {
        if (primitive.morph_targets.size() != most)
            file.note(where, "has primitives with fewer morph targets than others");
        primitive.morph_targets.resize(most);
    }
    if (!in.weights.empty() && in.weights.size() != most)
        file.note(where, "has " + std::to_string(in.weights.size()) + " weights for " + std::to_string(most) +
                             " morph targets");
    mesh.morph_weights.assign(most, 0.0f);
    for (std::size_t i = 0; i < std::min(most, in.weights.size()); ++i)
        mesh.morph_weights[i] = file.number(in.weights[i], where + " weights");
}

}  // namespace

std::vector<std::uint32_t> triangle_corners(File& file, const tinygltf::Primitive& in, const std::string& where) {
    Source source{file, in, where, 0, {}};
    if (in.mode < TINYGLTF_MODE_TRIANGLES || source.accessor("POSITION") < 0) return {};
    source.vertices = check_accessor(file, source.accessor("POSITION"), where).count;
    return triangle_list(source, read_indices(source));
}

void read_meshes(File& file, Scene& scene) {
    for (std::size_t m = 0; m < file.model.meshes.size(); ++m) {
        const tinygltf::Mesh& in = file.model.meshes[m];
        const std::string where = place("mesh", m, in.name);
        Mesh mesh;
        mesh.name = in.name;
        for (std::size_t p = 0; p < in.primitives.size(); ++p) {
            Primitive primitive;
            if (read_primitive(file, scene, in.primitives[p], where + " primitive " + std::to_string(p), primitive))
                mesh.primitives.push_back(std::move(primitive));
        }
        even_out_morph_targets(file, in, mesh, where);
        scene.meshes.push_back(std::move(mesh));
    }
}

}  // namespace daylit::gltf
