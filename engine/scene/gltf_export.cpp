// The file's JSON is edited in place, so that whatever daylit does not know stays as it was; new vertices are appended
// to its buffer.
#include "engine/scene/gltf_export.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "engine/base/file.h"
#include "engine/scene/gltf_file.h"

namespace daylit {
namespace {

using Json = nlohmann::json;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr std::size_t kAlignment = 4;

Json json_of(const std::vector<std::uint8_t>& bytes) {
    if (bytes.size() < 20 || std::memcmp(bytes.data(), "glTF", 4) != 0) return Json::parse(bytes);
    std::uint32_t length = 0;  // gltf::open has checked the framing
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return Json::parse(bytes.begin() + 20, bytes.begin() + 20 + std::ptrdiff_t(length));
}

/// Whether a texture of this material is drawn by TEXCOORD_1; extensions included.
bool draws_by_second_set(const Json& value) {
    if (value.is_object() && value.contains("texCoord") && value["texCoord"] == 1) return true;
    return value.is_structured() &&
           std::any_of(value.begin(), value.end(), [](const Json& inner) { return draws_by_second_set(inner); });
}

const char* mime_type(const std::vector<std::uint8_t>& image) {
    if (image.size() > 12 && std::memcmp(image.data(), "RIFF", 4) == 0) return "image/webp";
    return !image.empty() && image[0] == 0xff ? "image/jpeg" : "image/png";
}

/// A vertex of the new primitive: one of the old, at one place of the layout.
struct Split {
    std::vector<std::uint32_t> old, indices;
    std::vector<Vec2> uvs;
};

class Exporter {
  public:
    Exporter(const Scene& scene, const WorldMesh& mesh, std::span<const Vec2> corner_uvs)
        : scene_(scene),
          mesh_(mesh),
          corner_uvs_(corner_uvs),
          file_(gltf::open(scene.path)),
          json_(json_of(read_file(scene.path))) {}

    void run(const glm::ivec2& texels) {
        embed_buffers();
        embed_images();
        for (const PlacedMesh& placed : placed_meshes(scene_, Part::Static)) add(placed);
        for (const int node : emptied_) empty(node);
        note_size(texels);
        json_["buffers"] = Json::array({{{"byteLength", binary_.size()}}});
    }

    std::vector<std::uint8_t> glb() const {
        std::string text = json_.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<std::uint8_t> bytes;
        const auto put = [&](std::uint64_t number) {
            for (int i = 0; i < 4; ++i) bytes.push_back(std::uint8_t(number >> 8 * i));
        };
        const std::uint64_t total = 12 + 8 + text.size() + 8 + binary_.size();
        if (total > 0xffffffffu) throw Error(scene_.path.string(), "is too large to be written as .glb: 4 GB at most");
        put(0x46546C67), put(2), put(total);
        put(text.size()), put(0x4E4F534A), bytes.insert(bytes.end(), text.begin(), text.end());
        put(binary_.size()), put(0x004E4942), bytes.insert(bytes.end(), binary_.begin(), binary_.end());
        return bytes;
    }

  private:
    void align() { binary_.resize((binary_.size() + kAlignment - 1) / kAlignment * kAlignment, 0); }

    void embed_buffers() {
        std::vector<std::size_t> first;
        for (const tinygltf::Buffer& buffer : file_.model.buffers) {
            first.push_back(binary_.size());
            binary_.insert(binary_.end(), buffer.data.begin(), buffer.data.end());
            align();
        }
        if (!json_.contains("bufferViews")) json_["bufferViews"] = Json::array();
        for (Json& view : json_["bufferViews"]) {
            const std::size_t offset =
                view.value("byteOffset", std::size_t(0)) + first.at(view["buffer"].get<std::size_t>());
            view["buffer"] = 0, view["byteOffset"] = offset;
        }
    }

    void embed_images() {
        if (!json_.contains("images")) return;
        for (std::size_t i = 0; i < json_["images"].size() && i < file_.image_bytes.size(); ++i) {
            Json& image = json_["images"][i];
            const std::vector<std::uint8_t>& bytes = file_.image_bytes[i];
            if (bytes.empty() || !image.contains("uri") || image["uri"].get<std::string>().starts_with("data:"))
                continue;
            image.erase("uri");
            image["mimeType"] = mime_type(bytes);
            image["bufferView"] = add_view(bytes, {});
        }
    }

    std::size_t add_view(std::span<const std::uint8_t> bytes, const Json& more) {
        align();
        Json view = more.is_object() ? more : Json::object();
        view["buffer"] = 0, view["byteOffset"] = binary_.size(), view["byteLength"] = bytes.size();
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        align();
        json_["bufferViews"].push_back(view);
        return json_["bufferViews"].size() - 1;
    }

    template <typename T>
    std::size_t add_accessor(const std::vector<T>& values, Json accessor, int target) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
        accessor["bufferView"] = add_view({bytes, values.size() * sizeof(T)}, {{"target", target}});
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    void add(const PlacedMesh& placed) {
        Json mesh = json_["meshes"][std::size_t(scene_.nodes[std::size_t(placed.node)].mesh)];
        std::size_t triangle = placed.first_triangle;
        const auto& kept = scene_.meshes[std::size_t(scene_.nodes[std::size_t(placed.node)].mesh)].primitives;
        auto primitive = kept.begin();
        const auto& originals = file_.model.meshes[std::size_t(scene_.nodes[std::size_t(placed.node)].mesh)].primitives;
        for (std::size_t p = 0; p < originals.size(); ++p) {
            const std::vector<std::uint32_t> corners = gltf::triangle_corners(file_, originals[p], mesh_name(placed));
            if (corners.empty()) continue;
            while (primitive->topology != Topology::Triangles) ++primitive;
            rewrite(originals[p], mesh["primitives"][p], split(corners, *primitive, triangle));
            triangle += corners.size() / 3;
            first_vertex_ += primitive->positions.size();
            ++primitive;
        }
        json_["meshes"].push_back(std::move(mesh));
        hang(placed, json_["meshes"].size() - 1);
    }

    std::string mesh_name(const PlacedMesh& placed) const {
        const int mesh = scene_.nodes[std::size_t(placed.node)].mesh;
        return gltf::place("mesh", std::size_t(mesh), scene_.meshes[std::size_t(mesh)].name);
    }

    Split split(const std::vector<std::uint32_t>& corners, const Primitive& primitive, std::size_t triangle) const {
        Split result;
        std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> number;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::size_t t = triangle + i / 3;
            // Mirrored copies have their second and third corner exchanged in the world.
            const bool turned = mesh_.indices[3 * t + 1] - first_vertex_ != primitive.indices[i / 3 * 3 + 1];
            const std::size_t k = turned ? (3 - i % 3) % 3 : i % 3;
            const Vec2& uv = corner_uvs_[3 * t + k];
            const auto [found, fresh] = number.try_emplace({corners[i], uv.x, uv.y}, std::uint32_t(result.old.size()));
            if (fresh) result.old.push_back(corners[i]), result.uvs.push_back(uv);
            result.indices.push_back(found->second);
        }
        return result;
    }

    void rewrite(const tinygltf::Primitive& original, Json& primitive, const Split& split) {
        if (original.material >= 0 && draws_by_second_set(json_["materials"][std::size_t(original.material)]))
            file_.fail(gltf::place("material", std::size_t(original.material),
                                   file_.model.materials[std::size_t(original.material)].name),
                       "draws a texture by TEXCOORD_1, where the lightmap's layout goes; move it to TEXCOORD_0");
        for (auto& [name, accessor] : primitive["attributes"].items())
            if (name != "TEXCOORD_1") accessor = gathered(accessor.get<int>(), name, split.old);
        if (primitive.contains("targets"))
            for (Json& target : primitive["targets"])
                for (auto& [name, accessor] : target.items()) accessor = gathered(accessor.get<int>(), name, split.old);
        const Json uvs = {
            {"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT}, {"type", "VEC2"}, {"count", split.uvs.size()}};
        primitive["attributes"]["TEXCOORD_1"] = add_accessor(split.uvs, uvs, kArrayBuffer);
        if (!primitive["attributes"].contains("TEXCOORD_0")) {  // sets are numbered without gaps; zeros, as was taken
            primitive["attributes"]["TEXCOORD_0"] = json_["accessors"].size();
            json_["accessors"].push_back(uvs);
        }
        const Json indices = {{"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
                              {"type", "SCALAR"},
                              {"count", split.indices.size()}};
        primitive["indices"] = add_accessor(split.indices, indices, kElementArrayBuffer);
        primitive["mode"] = TINYGLTF_MODE_TRIANGLES;
        // Compressed copies of the old vertices.
        if (primitive.contains("extensions")) primitive["extensions"].erase("KHR_draco_mesh_compression");
    }

    /// A new accessor of the same kind with these elements.
    std::size_t gathered(int index, const std::string& name, const std::vector<std::uint32_t>& elements) {
        const tinygltf::Accessor& accessor = file_.model.accessors[std::size_t(index)];
        Json json = json_["accessors"][std::size_t(index)];
        for (const char* key : {"bufferView", "byteOffset", "sparse"}) json.erase(key);
        json["count"] = elements.size();
        if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.sparse.isSparse) {
            const std::vector<float> values = gltf::read_floats(file_, index, elements, name);
            json["componentType"] = TINYGLTF_COMPONENT_TYPE_FLOAT;
            json.erase("normalized");
            set_range(values, elements.size(), json);
            return add_accessor(values, std::move(json), kArrayBuffer);
        }
        const std::size_t size = std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType))) *
                                 std::size_t(tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type)));
        const std::size_t stride = (size + kAlignment - 1) / kAlignment * kAlignment;
        std::vector<std::uint8_t> bytes(stride * elements.size(), 0);
        gltf::check_accessor(file_, index, name);
        if (accessor.bufferView >= 0) {
            const tinygltf::BufferView& view = file_.model.bufferViews[std::size_t(accessor.bufferView)];
            const std::size_t step = view.byteStride != 0 ? view.byteStride : size;
            const unsigned char* from =
                file_.model.buffers[std::size_t(view.buffer)].data.data() + view.byteOffset + accessor.byteOffset;
            for (std::size_t i = 0; i < elements.size(); ++i)
                std::memcpy(bytes.data() + i * stride, from + elements[i] * step, size);
        }
        json["bufferView"] = add_view(bytes, {{"target", kArrayBuffer}, {"byteStride", stride}});
        json_["accessors"].push_back(std::move(json));
        return json_["accessors"].size() - 1;
    }

    static void set_range(const std::vector<float>& values, std::size_t count, Json& json) {
        if (!json.contains("min") && !json.contains("max")) return;
        const std::size_t n = values.size() / count;
        std::vector<float> low(values.begin(), values.begin() + std::ptrdiff_t(n)), high = low;
        for (std::size_t i = 0; i < values.size(); ++i) {
            low[i % n] = std::min(low[i % n], values[i]);
            high[i % n] = std::max(high[i % n], values[i]);
        }
        json["min"] = low, json["max"] = high;
    }

    /// Gives the node the mesh, or a child for each of its instances.
    void hang(const PlacedMesh& placed, std::size_t mesh) {
        Json& node = json_["nodes"][std::size_t(placed.node)];
        if (scene_.nodes[std::size_t(placed.node)].instances.empty()) {
            node["mesh"] = mesh;
            return;
        }
        Json child = {{"mesh", mesh}};
        const Json& attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        const std::array<std::pair<const char*, const char*>, 3> names = {
            {{"TRANSLATION", "translation"}, {"ROTATION", "rotation"}, {"SCALE", "scale"}}};
        const std::array<std::uint32_t, 1> element = {std::uint32_t(placed.instance)};
        for (const auto& [from, to] : names)
            if (attributes.contains(from))
                child[to] = gltf::read_floats(file_, attributes[from].get<int>(), element, from);
        if (node.contains("weights")) child["weights"] = node["weights"];
        if (node.contains("name"))
            child["name"] = node["name"].get<std::string>() + " " + std::to_string(placed.instance);
        json_["nodes"].push_back(std::move(child));
        json_["nodes"][std::size_t(placed.node)]["children"].push_back(json_["nodes"].size() - 1);
        if (placed.instance == 0) emptied_.push_back(placed.node);
    }

    void empty(int index) {
        Json& node = json_["nodes"][std::size_t(index)];
        node.erase("mesh"), node.erase("weights");
        node["extensions"].erase("EXT_mesh_gpu_instancing");
        if (node["extensions"].empty()) node.erase("extensions");
    }

    void note_size(const glm::ivec2& texels) {
        Json& scene = json_["scenes"][json_.value("scene", std::size_t(0))];
        if (scene.contains("extras") && !scene["extras"].is_object()) return;
        scene["extras"]["daylit"]["lightmap"] = {texels.x, texels.y};
    }

    const Scene& scene_;
    const WorldMesh& mesh_;
    std::span<const Vec2> corner_uvs_;
    gltf::File file_;
    Json json_;
    std::vector<std::uint8_t> binary_;
    std::size_t first_vertex_ = 0;  // in mesh_, of the primitive at hand
    std::vector<int> emptied_;      // nodes whose instances have become nodes
};

}  // namespace

void export_glb(const Scene& scene, const WorldMesh& mesh, std::span<const Vec2> corner_uvs, const glm::ivec2& texels,
                const std::filesystem::path& path) {
    assert(corner_uvs.size() == mesh.indices.size());
    Exporter exporter(scene, mesh, corner_uvs);
    exporter.run(texels);
    write_file(path, exporter.glb());
}

}  // namespace daylit
