// What tinygltf takes on trust: GLB framing (glTF 2.0, section 4.4), the types of JSON properties (chapter 5; a wrong
// one is silently left out by tinygltf), how deep the JSON nests (both parsers recurse), sizes of buffer views.
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "engine/scene/gltf_file.h"

namespace daylit::gltf {
namespace {

using Json = nlohmann::json;

constexpr int kMaxDepth = 64;
// A value of JSON takes two bytes in the file and some 200 in tinygltf.
constexpr std::size_t kMaxJsonValues = std::size_t(1) << 23;

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t little_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
    return std::uint32_t(bytes[at]) | std::uint32_t(bytes[at + 1]) << 8 | std::uint32_t(bytes[at + 2]) << 16 |
           std::uint32_t(bytes[at + 3]) << 24;
}

/// The JSON chunk of a GLB whose framing is sound.
std::string_view json_of_glb(std::span<const std::uint8_t> bytes, File& file) {
    if (bytes.size() < kHeaderBytes + kChunkHeaderBytes) file.fail("GLB", "is cut off in its header");
    if (const std::uint32_t version = little_endian(bytes, 4); version != 2)
        file.fail("GLB", "is of version " + std::to_string(version) + "; only 2 is read, convert it");
    const std::size_t length = little_endian(bytes, 8);
    if (length != bytes.size())
        file.fail("GLB",
                  "says that it is " + std::to_string(length) + " bytes long and is " + std::to_string(bytes.size()));
    std::string_view json;
    std::size_t at = kHeaderBytes;
    for (int chunk = 0; at < length; ++chunk) {
        const std::string where = "GLB chunk " + std::to_string(chunk);
        if (length - at < kChunkHeaderBytes) file.fail(where, "is cut off in its header");
        const std::size_t size = little_endian(bytes, at);
        const std::uint32_t type = little_endian(bytes, at + 4);
        at += kChunkHeaderBytes;
        if (size > length - at) file.fail(where, "reaches beyond the end of the file");
        if (size % 4 != 0) file.fail(where, "is not a multiple of 4 bytes long");
        if ((type == kJsonChunk) != (chunk == 0) || (type == kBinaryChunk && chunk > 1))
            file.fail(where, "is out of place: one JSON chunk first, then one BIN chunk at most");
        if (type == kJsonChunk)
            json = {reinterpret_cast<const char*>(bytes.data()) + at, size};
        else if (type != kBinaryChunk)
            file.note(where, "is of an unknown type; ignored");
        at += size;
    }
    return json;
}

/// Before any parser sees it; strings are skipped.
void check_extent(std::string_view json, const File& file) {
    int depth = 0;
    std::size_t values = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string) {
            if (c == '\\') ++i;
            in_string = c != '"';
            continue;
        }
        in_string = c == '"';
        values += c == ',' || c == '{' || c == '[';
        if (c == '{' || c == '[') ++depth;
        if (c == '}' || c == ']') --depth;
        if (depth > kMaxDepth) file.fail("JSON", "is nested more than " + std::to_string(kMaxDepth) + " deep");
        if (values > kMaxJsonValues) file.fail("JSON", "has more than 8 million values");
    }
}

enum class Type {
    Boolean,
    Number,
    Natural,
    String,
    Object,
    Objects,
    Numbers,
    Naturals,
    Strings,
    NaturalMap,
    NaturalMaps
};

/// One property of one kind of object; `child` is the kind of object that it holds.
struct Rule {
    std::string_view kind, name;
    Type type;
    bool required = false;
    std::string_view child = {};
};

constexpr Rule kRules[] = {
    {"file", "asset", Type::Object, true, "asset"},
    {"file", "scene", Type::Natural},
    {"file", "extensionsUsed", Type::Strings},
    {"file", "extensionsRequired", Type::Strings},
    {"file", "accessors", Type::Objects, false, "accessor"},
    {"file", "animations", Type::Objects, false, "animation"},
    {"file", "buffers", Type::Objects, false, "buffer"},
    {"file", "bufferViews", Type::Objects, false, "bufferView"},
    {"file", "cameras", Type::Objects, false, "camera"},
    {"file", "images", Type::Objects, false, "image"},
    {"file", "materials", Type::Objects, false, "material"},
    {"file", "meshes", Type::Objects, false, "mesh"},
    {"file", "nodes", Type::Objects, false, "node"},
    {"file", "samplers", Type::Objects, false, "sampler"},
    {"file", "scenes", Type::Objects, false, "scene"},
    {"file", "skins", Type::Objects, false, "skin"},
    {"file", "textures", Type::Objects, false, "texture"},
    {"asset", "version", Type::String, true},
    {"asset", "minVersion", Type::String},
    {"accessor", "bufferView", Type::Natural},
    {"accessor", "byteOffset", Type::Natural},
    {"accessor", "componentType", Type::Natural, true},
    {"accessor", "normalized", Type::Boolean},
    {"accessor", "count", Type::Natural, true},
    {"accessor", "type", Type::String, true},
    {"accessor", "min", Type::Numbers},
    {"accessor", "max", Type::Numbers},
    {"accessor", "sparse", Type::Object, false, "sparse"},
    {"sparse", "count", Type::Natural, true},
    {"sparse", "indices", Type::Object, true, "sparse indices"},
    {"sparse", "values", Type::Object, true, "sparse values"},
    {"sparse indices", "bufferView", Type::Natural, true},
    {"sparse indices", "byteOffset", Type::Natural},
    {"sparse indices", "componentType", Type::Natural, true},
    {"sparse values", "bufferView", Type::Natural, true},
    {"sparse values", "byteOffset", Type::Natural},
    {"animation", "channels", Type::Objects, true, "channel"},
    {"animation", "samplers", Type::Objects, true, "animation sampler"},
    {"channel", "sampler", Type::Natural, true},
    {"channel", "target", Type::Object, true, "target"},
    {"target", "node", Type::Natural},
    {"target", "path", Type::String, true},
    {"animation sampler", "input", Type::Natural, true},
    {"animation sampler", "output", Type::Natural, true},
    {"animation sampler", "interpolation", Type::String},
    {"buffer", "byteLength", Type::Natural, true},
    {"buffer", "uri", Type::String},
    {"bufferView", "buffer", Type::Natural, true},
    {"bufferView", "byteOffset", Type::Natural},
    {"bufferView", "byteLength", Type::Natural, true},
    {"bufferView", "byteStride", Type::Natural},
    {"bufferView", "target", Type::Natural},
    {"camera", "type", Type::String, true},
    {"camera", "perspective", Type::Object, false, "perspective"},
    {"camera", "orthographic", Type::Object, false, "orthographic"},
    {"perspective", "yfov", Type::Number, true},
    {"perspective", "znear", Type::Number, true},
    {"perspective", "zfar", Type::Number},
    {"perspective", "aspectRatio", Type::Number},
    {"orthographic", "xmag", Type::Number, true},
    {"orthographic", "ymag", Type::Number, true},
    {"orthographic", "znear", Type::Number, true},
    {"orthographic", "zfar", Type::Number, true},
    {"image", "uri", Type::String},
    {"image", "mimeType", Type::String},
    {"image", "bufferView", Type::Natural},
    {"material", "pbrMetallicRoughness", Type::Object, false, "pbr"},
    {"material", "normalTexture", Type::Object, false, "textureInfo"},
    {"material", "occlusionTexture", Type::Object, false, "textureInfo"},
    {"material", "emissiveTexture", Type::Object, false, "textureInfo"},
    {"material", "emissiveFactor", Type::Numbers},
    {"material", "alphaMode", Type::String},
    {"material", "alphaCutoff", Type::Number},
    {"material", "doubleSided", Type::Boolean},
    {"pbr", "baseColorFactor", Type::Numbers},
    {"pbr", "baseColorTexture", Type::Object, false, "textureInfo"},
    {"pbr", "metallicFactor", Type::Number},
    {"pbr", "roughnessFactor", Type::Number},
    {"pbr", "metallicRoughnessTexture", Type::Object, false, "textureInfo"},
    {"textureInfo", "index", Type::Natural, true},
    {"textureInfo", "texCoord", Type::Natural},
    {"textureInfo", "scale", Type::Number},
    {"textureInfo", "strength", Type::Number},
    {"mesh", "primitives", Type::Objects, true, "primitive"},
    {"mesh", "weights", Type::Numbers},
    {"primitive", "attributes", Type::NaturalMap, true},
    {"primitive", "indices", Type::Natural},
    {"primitive", "material", Type::Natural},
    {"primitive", "mode", Type::Natural},
    {"primitive", "targets", Type::NaturalMaps},
    {"node", "camera", Type::Natural},
    {"node", "children", Type::Naturals},
    {"node", "skin", Type::Natural},
    {"node", "mesh", Type::Natural},
    {"node", "matrix", Type::Numbers},
    {"node", "rotation", Type::Numbers},
    {"node", "scale", Type::Numbers},
    {"node", "translation", Type::Numbers},
    {"node", "weights", Type::Numbers},
    {"sampler", "magFilter", Type::Natural},
    {"sampler", "minFilter", Type::Natural},
    {"sampler", "wrapS", Type::Natural},
    {"sampler", "wrapT", Type::Natural},
    {"scene", "nodes", Type::Naturals},
    {"skin", "inverseBindMatrices", Type::Natural},
    {"skin", "skeleton", Type::Natural},
    {"skin", "joints", Type::Naturals, true},
    {"texture", "sampler", Type::Natural},
    {"texture", "source", Type::Natural},
};

/// The rules of one kind stand together.
std::span<const Rule> rules_of(std::string_view kind) {
    const auto is_kind = [&](const Rule& rule) { return rule.kind == kind; };
    const auto first = std::find_if(std::begin(kRules), std::end(kRules), is_kind);
    return {first, std::find_if_not(first, std::end(kRules), is_kind)};
}

bool all_of(const Json& array, bool (*holds)(const Json&)) {
    return array.is_array() && std::all_of(array.begin(), array.end(), holds);
}

bool is_natural(const Json& value) {
    return value.is_number_unsigned();
}
bool is_natural_map(const Json& value) {
    return value.is_object() && std::all_of(value.begin(), value.end(), is_natural);
}

/// Empty when the value is of the type, else what it must be.
std::string_view mismatch(const Json& value, Type type) {
    const auto unless = [](bool fits, std::string_view what) { return fits ? std::string_view() : what; };
    switch (type) {
        case Type::Boolean:
            return unless(value.is_boolean(), "true or false");
        case Type::Number:
            return unless(value.is_number(), "a number");
        case Type::Natural:
            return unless(is_natural(value), "an integer from 0 up");
        case Type::String:
            return unless(value.is_string(), "a string");
        case Type::Object:
            return unless(value.is_object(), "an object");
        case Type::Objects:
            return unless(all_of(value, [](const Json& v) { return v.is_object(); }), "an array of objects");
        case Type::Numbers:
            return unless(all_of(value, [](const Json& v) { return v.is_number(); }), "an array of numbers");
        case Type::Naturals:
            return unless(all_of(value, is_natural), "an array of integers from 0 up");
        case Type::Strings:
            return unless(all_of(value, [](const Json& v) { return v.is_string(); }), "an array of strings");
        case Type::NaturalMap:
            return unless(is_natural_map(value), "an object of integers from 0 up");
        case Type::NaturalMaps:
            return unless(all_of(value, is_natural_map), "an array of objects of integers from 0 up");
    }
    return {};
}

class Checker {
  public:
    explicit Checker(File& file) : file_(file) {}

    void check(const Json& object, std::string_view kind, const std::string& where) {
        for (const Rule& rule : rules_of(kind)) check_property(object, rule, where);
        check_common(object, where);
    }

  private:
    void check_common(const Json& object, const std::string& where) {
        if (const auto name = object.find("name"); name != object.end() && !name->is_string())
            file_.fail(where, "name must be a string");
        const auto extensions = object.find("extensions");
        if (extensions == object.end()) return;
        const bool objects = extensions->is_object() && std::all_of(extensions->begin(), extensions->end(),
                                                                    [](const Json& v) { return v.is_object(); });
        if (!objects) file_.fail(where, "extensions must be an object of objects");
    }

    void check_property(const Json& object, const Rule& rule, const std::string& where) {
        const auto value = object.find(rule.name);
        if (value == object.end()) {
            if (rule.required) file_.fail(where, "has no " + std::string(rule.name));
            return;
        }
        const std::string_view needed = mismatch(*value, rule.type);
        if (!needed.empty()) file_.fail(where, std::string(rule.name) + " must be " + std::string(needed));
        if (value->is_array() && value->empty()) file_.note(where, std::string(rule.name) + " is an empty array");
        if (rule.child.empty()) return;
        if (!value->is_array()) return check(*value, rule.child, named(where, rule.name));
        for (std::size_t i = 0; i < value->size(); ++i)
            check((*value)[i], rule.child, named(where, rule.child) + " " + std::to_string(i));
    }

    static std::string named(const std::string& where, std::string_view name) {
        return where == "file" ? std::string(name) : where + " " + std::string(name);
    }

    File& file_;
};

std::uint64_t natural(const Json& object, const char* name, std::uint64_t otherwise = 0) {
    const auto value = object.find(name);
    return value == object.end() ? otherwise : value->get<std::uint64_t>();
}

/// tinygltf indexes a buffer with an image's view unchecked.
void check_views(const Json& root, File& file) {
    if (!root.contains("bufferViews")) return;
    const Json none = Json::array();
    const Json& buffers = root.contains("buffers") ? root["buffers"] : none;
    for (std::size_t i = 0; i < root["bufferViews"].size(); ++i) {
        const Json& view = root["bufferViews"][i];
        const std::string where = place("bufferView", i);
        const std::uint64_t buffer = natural(view, "buffer"), offset = natural(view, "byteOffset");
        const std::uint64_t length = natural(view, "byteLength"), stride = natural(view, "byteStride");
        if (buffer >= buffers.size())
            file.fail(where, "refers to buffer " + std::to_string(buffer) + ", which does not exist");
        const std::uint64_t size = natural(buffers[buffer], "byteLength");
        if (length == 0) file.fail(where, "is empty");
        if (offset > size || length > size - offset)
            file.fail(where,
                      "reaches beyond the " + std::to_string(size) + " bytes of buffer " + std::to_string(buffer));
        if (stride > length) file.note(where, "has a stride longer than itself");
    }
}

void check_required_extensions(const Json& root, const File& file) {
    if (!root.contains("extensionsRequired")) return;
    for (const Json& name : root["extensionsRequired"])
        if (!is_supported(name.get<std::string>()))
            file.fail("extension " + name.get<std::string>(),
                      "is required by the file and not supported; export without it");
}

void check_version(const Json& root, File& file) {
    const auto text = [&](const char* key) -> std::string {
        if (!root.contains("asset") || !root["asset"].is_object() || !root["asset"].contains(key)) return {};
        const Json& value = root["asset"][key];
        return value.is_string() ? value.get<std::string>() : std::string();
    };
    const std::string version = text("version"), least = text("minVersion");
    if (!version.empty() && !version.starts_with("2."))
        file.fail("asset", "is glTF version '" + version + "'; only 2.x is read, convert it");
    if (!least.empty() && least != "2.0") file.note("asset", "asks for at least version " + least + "; read as 2.0");
}

Json parsed(std::string_view json, const File& file) {
    try {
        Json root = Json::parse(json);
        if (!root.is_object()) file.fail("JSON", "is not an object");
        return root;
    } catch (const Json::exception& exception) {
        file.fail("JSON", std::string("is broken: ") + exception.what());
    }
}

}  // namespace

Document check_document(std::span<const std::uint8_t> bytes, File& file) {
    if (bytes.empty()) throw Error(file.path.string(), "is an empty file");
    Document document;
    document.binary = bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
    const std::string_view json = document.binary
                                      ? json_of_glb(bytes, file)
                                      : std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (json.starts_with("\xEF\xBB\xBF")) file.note("JSON", "starts with a byte order mark, which glTF forbids");
    check_extent(json, file);
    const Json root = parsed(json, file);
    check_version(root, file);
    if (const auto used = root.find("extensionsRequired"); used != root.end() && mismatch(*used, Type::Strings).empty())
        check_required_extensions(root, file);
    Checker(file).check(root, "file", "file");
    check_views(root, file);
    return document;
}

}  // namespace daylit::gltf
