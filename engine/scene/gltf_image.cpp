// Textures, samplers and images; only what materials use is decoded.
#include <tbb/parallel_for.h>

#include <algorithm>

#include "engine/scene/gltf_file.h"

namespace daylit::gltf {
namespace {

// All images together: 1 GiB of RGBA. A small file can declare any number of huge flat-coloured pictures.
constexpr std::size_t kMaxScenePixels = std::size_t(1) << 28;

std::vector<TextureRef*> texture_refs(Scene& scene) {
    std::vector<TextureRef*> refs;
    for (Material& material : scene.materials)
        for (TextureRef* ref :
             {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
              &material.occlusion_texture, &material.emission_texture, &material.specular_texture,
              &material.specular_color_texture, &material.transmission_texture})
            if (ref->texture >= 0) refs.push_back(ref);
    return refs;
}

/// The image of a texture: its own, or that of EXT_texture_webp when it has no other.
int source_image(File& file, const tinygltf::Texture& texture, const std::string& place) {
    int source = texture.source;
    const auto webp = texture.extensions.find("EXT_texture_webp");
    if (source < 0 && webp != texture.extensions.end() && webp->second.IsObject() && webp->second.Has("source"))
        source = webp->second.Get("source").GetNumberAsInt();
    if (source == -1) return -1;
    if (!in_range(source, file.model.images))
        file.fail(place, "refers to image " + std::to_string(source) + ", which does not exist");
    return source;
}

Wrap wrap(File& file, int mode, const std::string& place) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::Clamp;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::Mirror;
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Wrap::Repeat;
        default:
            file.note(place, "has an unknown wrap mode; it repeats");
            return Wrap::Repeat;
    }
}

Texture read_texture(File& file, const tinygltf::Texture& in, const std::string& place) {
    Texture out;
    out.image = source_image(file, in, place);
    if (in.sampler == -1) return out;
    if (!in_range(in.sampler, file.model.samplers))
        file.fail(place, "refers to sampler " + std::to_string(in.sampler) + ", which does not exist");
    const tinygltf::Sampler& sampler = file.model.samplers[std::size_t(in.sampler)];
    out.wrap_s = wrap(file, sampler.wrapS, place);
    out.wrap_t = wrap(file, sampler.wrapT, place);
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) out.filter = Filter::Nearest;
    return out;
}

std::string image_name(const File& file, std::size_t index) {
    const tinygltf::Image& image = file.model.images[index];
    return one_line(place("image", index, image.uri.empty() ? image.name : image.uri));
}

/// Keeps the used textures and images only, in the file's order, and renumbers the references to them.
std::vector<int> keep_used(File& file, Scene& scene) {
    std::vector<int> texture_number(file.model.textures.size(), -1), image_number(file.model.images.size(), -1);
    const std::vector<TextureRef*> refs = texture_refs(scene);
    std::vector<bool> used(file.model.textures.size(), false);
    for (const TextureRef* ref : refs) used[std::size_t(ref->texture)] = true;
    std::vector<int> images;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const tinygltf::Texture& in = file.model.textures[i];
        Texture texture = read_texture(file, in, place("texture", i, in.name));
        if (!used[i]) continue;
        if (texture.image < 0) {
            file.note(place("texture", i, in.name), "has no image; materials use their factors alone");
            continue;
        }
        int& number = image_number[std::size_t(texture.image)];
        if (number < 0) {
            number = int(images.size());
            images.push_back(texture.image);
        }
        texture.image = number;
        texture_number[i] = int(scene.textures.size());
        scene.textures.push_back(texture);
    }
    for (TextureRef* ref : refs) {
        ref->texture = texture_number[std::size_t(ref->texture)];
        if (ref->texture < 0) *ref = TextureRef();
    }
    return images;
}

void note_unused_images(File& file, const std::vector<int>& used) {
    for (std::size_t i = 0; i < file.model.images.size(); ++i)
        if (std::find(used.begin(), used.end(), int(i)) == used.end())
            file.note(image_name(file, i), "is used by no material; not read");
}

/// Glossiness in alpha becomes roughness in green, in a texture of its own: the colours stay the specular colour's.
void convert_glossy(Scene& scene, const GlossyMaterial& glossy) {
    Material& material = scene.materials[glossy.material];
    TextureRef& ref = material.metallic_roughness_texture;
    if (ref.texture < 0) {
        material.roughness = 1.0f - glossy.glossiness;
        return;
    }
    Texture texture = scene.textures[std::size_t(ref.texture)];
    Image8 image = scene.images[std::size_t(texture.image)];
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        std::uint8_t* texel = &image.rgba[i];
        texel[1] = std::uint8_t(255.5f - glossy.glossiness * float(texel[3]));
        texel[0] = texel[2] = 0;
        texel[3] = 255;
    }
    scene.image_names.push_back("roughness of " + scene.image_names[std::size_t(texture.image)]);
    texture.image = int(scene.images.size());
    scene.images.push_back(std::move(image));
    ref.texture = int(scene.textures.size());
    scene.textures.push_back(texture);
}

}  // namespace

void read_textures(File& file, Scene& scene) {
    const std::vector<int> used = keep_used(file, scene);
    note_unused_images(file, used);
    const auto bytes = [&](std::size_t i) -> const std::vector<std::uint8_t>& {
        return file.image_bytes[std::size_t(used[i])];
    };
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
        scene.image_names.push_back(image_name(file, std::size_t(used[i])));
        if (bytes(i).empty()) file.fail(scene.image_names[i], "is absent or empty; put it beside the scene");
        const std::array<int, 2> size = declared_image_size(bytes(i), file.path.string() + ": " + scene.image_names[i]);
        pixels += std::size_t(size[0]) * std::size_t(size[1]);
        if (pixels > kMaxScenePixels) file.fail(scene.image_names[i], "makes all textures together larger than 1 GiB");
    }
    scene.images.resize(used.size());
    tbb::parallel_for(std::size_t(0), used.size(), [&](std::size_t i) {
        scene.images[i] = read_image8(bytes(i), file.path.string() + ": " + scene.image_names[i]);
    });
    for (const GlossyMaterial& glossy : file.glossy) convert_glossy(scene, glossy);
}

}  // namespace daylit::gltf
