// Materials and the extensions that daylit knows, mapped to Material.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/scene/gltf_file.h"

namespace daylit::gltf {
namespace {

using tinygltf::Value;

/// Reads of one JSON object of an extension, with defaults for what is absent.
class Extension {
  public:
    Extension(const File& file, const tinygltf::ExtensionMap& extensions, const char* name, std::string place)
        : file_(file), place_(std::move(place)) {
        const auto found = extensions.find(name);
        if (found != extensions.end() && found->second.IsObject()) value_ = &found->second;
    }
    explicit operator bool() const { return value_ != nullptr; }
    bool has(const char* key) const { return value_ && value_->Has(key); }

    float number(const char* key, float otherwise) const {
        if (!has(key)) return otherwise;
        if (!value_->Get(key).IsNumber()) file_.fail(place_ + " " + key, "must be a number");
        return file_.number(value_->Get(key).GetNumberAsDouble(), place_ + " " + key);
    }
    template <int N>
    glm::vec<N, float> numbers(const char* key, glm::vec<N, float> otherwise) const {
        if (!has(key)) return otherwise;
        const Value& array = value_->Get(key);
        const std::string where = place_ + " " + key;
        if (!array.IsArray() || array.ArrayLen() != std::size_t(N))
            file_.fail(where, "must be an array of " + std::to_string(N));
        for (int i = 0; i < N; ++i) {
            if (!array.Get(i).IsNumber()) file_.fail(where, "must hold numbers");
            otherwise[i] = file_.number(array.Get(i).GetNumberAsDouble(), where);
        }
        return otherwise;
    }
    /// A textureInfo object inside the extension.
    tinygltf::TextureInfo texture(const char* key) const {
        tinygltf::TextureInfo info;
        if (!has(key)) return info;
        const Value& object = value_->Get(key);
        if (!object.IsObject() || !object.Get("index").IsInt()) file_.fail(place_ + " " + key, "must name a texture");
        const auto integer = [&](const char* name, int otherwise) {
            return object.Has(name) && object.Get(name).IsInt() ? object.Get(name).GetNumberAsInt() : otherwise;
        };
        info.index = integer("index", -1);
        info.texCoord = integer("texCoord", 0);
        if (object.Has("extensions") && object.Get("extensions").IsObject())
            info.extensions = object.Get("extensions").Get<Value::Object>();
        return info;
    }

  private:
    const File& file_;
    const Value* value_ = nullptr;
    std::string place_;
};

/// KHR_texture_transform: translation * rotation * scale; the rotation is counter-clockwise as one sees the picture,
/// whose v axis points down.
std::array<float, 6> affine(const Extension& transform) {
    const glm::vec2 offset = transform.numbers<2>("offset", glm::vec2(0));
    const glm::vec2 scale = transform.numbers<2>("scale", glm::vec2(1));
    const float angle = transform.number("rotation", 0.0f);
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * scale.x, s * scale.y, offset.x, -s * scale.x, c * scale.y, offset.y};
}

template <typename Info>  // TextureInfo, NormalTextureInfo or OcclusionTextureInfo
TextureRef texture_ref(File& file, const Info& info, const std::string& place) {
    TextureRef ref;
    if (info.index == -1) return ref;
    if (!in_range(info.index, file.model.textures))
        file.fail(place, "refers to texture " + std::to_string(info.index) + ", which does not exist");
    ref.texture = info.index;
    ref.uv_set = info.texCoord;
    const Extension transform(file, info.extensions, "KHR_texture_transform", place);
    if (transform) {
        ref.transform = affine(transform);
        ref.uv_set = int(transform.number("texCoord", float(ref.uv_set)));
    }
    if (ref.uv_set < 0 || ref.uv_set > 1) {
        file.note(place, "uses TEXCOORD_" + std::to_string(ref.uv_set) + "; only sets 0 and 1 are carried, 0 is taken");
        ref.uv_set = 0;
    }
    return ref;
}

float clamped(File& file, float value, float low, float high, const std::string& place) {
    if (value >= low && value <= high) return value;
    const float inside = std::clamp(value, low, high);
    file.note(place, "is " + std::to_string(value) + ", outside its range; " + std::to_string(inside) + " is taken");
    return inside;
}

template <int N>
glm::vec<N, float> clamped(File& file, glm::vec<N, float> value, float high, const std::string& place) {
    for (int i = 0; i < N; ++i) value[i] = clamped(file, value[i], 0.0f, high, place);
    return value;
}

template <int N>
glm::vec<N, float> factor(File& file, const std::vector<double>& values, glm::vec<N, float> otherwise, float high,
                          const std::string& place) {
    if (values.empty()) return otherwise;
    if (values.size() != std::size_t(N)) file.fail(place, "must have " + std::to_string(N) + " numbers");
    for (int i = 0; i < N; ++i) otherwise[i] = file.number(values[std::size_t(i)], place);
    return clamped<N>(file, otherwise, high, place);
}

constexpr float kAny = 3.0e38f;

AlphaMode alpha_mode(File& file, const std::string& mode, const std::string& place) {
    if (mode == "MASK") return AlphaMode::Mask;
    if (mode == "BLEND") return AlphaMode::Blend;
    if (mode != "OPAQUE" && !mode.empty())
        file.note(place, "has the unknown alphaMode '" + mode + "'; OPAQUE is taken");
    return AlphaMode::Opaque;
}

void read_specular(File& file, const tinygltf::Material& in, Material& out, const std::string& at) {
    const Extension specular(file, in.extensions, "KHR_materials_specular", at);
    if (!specular) return;
    out.specular = clamped(file, specular.number("specularFactor", 1.0f), 0.0f, 1.0f, at + " specularFactor");
    out.specular_color =
        clamped<3>(file, specular.numbers<3>("specularColorFactor", Rgb(1.0f)), kAny, at + " specularColorFactor");
    out.specular_texture = texture_ref(file, specular.texture("specularTexture"), at + " specularTexture");
    out.specular_color_texture =
        texture_ref(file, specular.texture("specularColorTexture"), at + " specularColorTexture");
}

void read_transmission(File& file, const tinygltf::Material& in, Material& out, const std::string& at) {
    const Extension transmission(file, in.extensions, "KHR_materials_transmission", at);
    if (transmission) {
        out.transmission =
            clamped(file, transmission.number("transmissionFactor", 0.0f), 0.0f, 1.0f, at + " transmissionFactor");
        out.transmission_texture =
            texture_ref(file, transmission.texture("transmissionTexture"), at + " transmissionTexture");
    }
    const Extension ior(file, in.extensions, "KHR_materials_ior", at);
    if (!ior) return;
    out.ior = ior.number("ior", 1.5f);
    // 0 is the extension's way to say that everything is reflected.
    if (out.ior != 0.0f) out.ior = clamped(file, out.ior, 1.0f, 100.0f, at + " ior");
}

/// Diffuse and specular colours with glossiness are exactly what a dielectric with a coloured coat gives:
/// base colour = diffuse, coat f0 = specular (shaders/shared/brdf.h scales the diffuse part by 1 - max f0 as the
/// extension does). f0 is carried as specular_color over the 0.04 of ior 1.5.
void read_specular_glossiness(File& file, const tinygltf::Material& in, std::size_t index, Material& out,
                              const std::string& at) {
    const Extension gloss(file, in.extensions, "KHR_materials_pbrSpecularGlossiness", at);
    if (!gloss) return;
    out.base_color = clamped<4>(file, gloss.numbers<4>("diffuseFactor", Rgba(1.0f)), 1.0f, at + " diffuseFactor");
    out.base_color_texture = texture_ref(file, gloss.texture("diffuseTexture"), at + " diffuseTexture");
    out.metallic = 0.0f;
    const float glossiness =
        clamped(file, gloss.number("glossinessFactor", 1.0f), 0.0f, 1.0f, at + " glossinessFactor");
    out.metallic_roughness_texture =
        texture_ref(file, gloss.texture("specularGlossinessTexture"), at + " specularGlossinessTexture");
    const bool textured = out.metallic_roughness_texture.texture >= 0 && !file.lambert;
    out.roughness = textured ? 1.0f : 1.0f - glossiness;
    if (textured) file.glossy.push_back({index, glossiness});
    out.ior = 1.5f;
    out.specular = 1.0f;
    out.specular_texture = TextureRef();
    out.specular_color =
        clamped<3>(file, gloss.numbers<3>("specularFactor", Rgb(1.0f)), 1.0f, at + " specularFactor") / 0.04f;
    out.specular_color_texture = out.metallic_roughness_texture;
}

void read_emission(File& file, const tinygltf::Material& in, Material& out, const std::string& at) {
    out.emission = factor<3>(file, in.emissiveFactor, Rgb(0.0f), kAny, at + " emissiveFactor");
    const Extension strength(file, in.extensions, "KHR_materials_emissive_strength", at);
    if (strength)
        out.emission *= clamped(file, strength.number("emissiveStrength", 1.0f), 0.0f, kAny, at + " emissiveStrength");
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(out.emission[c])) file.fail(at, "emits more than a float can hold");
    out.emission_texture = texture_ref(file, in.emissiveTexture, at + " emissiveTexture");
    out.lit = read_lit(file, in.extras, at);
}

/// --materials lambert: base colour and emission are left.
void make_lambert(Material& material) {
    material.metallic = 0.0f;
    material.roughness = 1.0f;
    material.specular = 0.0f;
    material.transmission = 0.0f;
    material.metallic_roughness_texture = material.normal_texture = material.occlusion_texture = TextureRef();
    material.specular_texture = material.specular_color_texture = material.transmission_texture = TextureRef();
}

Material read_material(File& file, const tinygltf::Material& in, std::size_t index) {
    const std::string at = place("material", index, in.name);
    Material out;
    out.name = in.name;
    const tinygltf::PbrMetallicRoughness& pbr = in.pbrMetallicRoughness;
    out.base_color = factor<4>(file, pbr.baseColorFactor, Rgba(1.0f), 1.0f, at + " baseColorFactor");
    out.base_color_texture = texture_ref(file, pbr.baseColorTexture, at + " baseColorTexture");
    out.metallic = clamped(file, file.number(pbr.metallicFactor, at), 0.0f, 1.0f, at + " metallicFactor");
    out.roughness = clamped(file, file.number(pbr.roughnessFactor, at), 0.0f, 1.0f, at + " roughnessFactor");
    out.metallic_roughness_texture = texture_ref(file, pbr.metallicRoughnessTexture, at + " metallicRoughnessTexture");
    out.normal_texture = texture_ref(file, in.normalTexture, at + " normalTexture");
    out.normal_scale = file.number(in.normalTexture.scale, at + " normalTexture");
    out.occlusion_texture = texture_ref(file, in.occlusionTexture, at + " occlusionTexture");
    out.alpha_mode = alpha_mode(file, in.alphaMode, at);
    out.alpha_cutoff = clamped(file, file.number(in.alphaCutoff, at), 0.0f, kAny, at + " alphaCutoff");
    out.double_sided = in.doubleSided;
    out.unlit = in.extensions.contains("KHR_materials_unlit");
    read_emission(file, in, out, at);
    read_specular(file, in, out, at);
    read_transmission(file, in, out, at);
    read_specular_glossiness(file, in, index, out, at);
    if (file.lambert) make_lambert(out);
    return out;
}

}  // namespace

void read_materials(File& file, Scene& scene) {
    for (std::size_t i = 0; i < file.model.materials.size(); ++i) {
        scene.materials.push_back(read_material(file, file.model.materials[i], i));
    }
    // The last one is what primitives without a material use; its values are glTF's defaults.
    scene.materials.emplace_back();
    if (file.lambert) make_lambert(scene.materials.back());
}

}  // namespace daylit::gltf
