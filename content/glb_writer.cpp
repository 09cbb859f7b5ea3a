#include "content/glb_writer.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/file.h"

namespace daylit::content {
namespace {

using tinygltf::Value;

// Appends to the one binary buffer; every view starts on a multiple of four bytes, as accessors need.
class Buffer {
  public:
    explicit Buffer(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

    int view(const void* data, std::size_t bytes, int target) {
        auto& all = model_.buffers[0].data;
        all.resize((all.size() + 3) / 4 * 4);
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = all.size();
        view.byteLength = bytes;
        view.target = target;
        all.resize(all.size() + bytes);
        std::memcpy(all.data() + view.byteOffset, data, bytes);
        model_.bufferViews.push_back(view);
        return int(model_.bufferViews.size()) - 1;
    }

    template <class T>
    int accessor(const std::vector<T>& values, int component_type, int type, int target = 0) {
        tinygltf::Accessor accessor;
        accessor.bufferView = view(values.data(), values.size() * sizeof(T), target);
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = values.size();
        model_.accessors.push_back(accessor);
        return int(model_.accessors.size()) - 1;
    }

    int floats(const std::vector<float>& v) {
        const int a = accessor(v, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR);
        model_.accessors[std::size_t(a)].minValues = {*std::min_element(v.begin(), v.end())};
        model_.accessors[std::size_t(a)].maxValues = {*std::max_element(v.begin(), v.end())};
        return a;
    }
    int vec2s(const std::vector<Vec2>& v) { return attribute(v, TINYGLTF_TYPE_VEC2); }
    int vec3s(const std::vector<Vec3>& v) { return attribute(v, TINYGLTF_TYPE_VEC3); }
    int vec4s(const std::vector<Vec4>& v) { return attribute(v, TINYGLTF_TYPE_VEC4); }
    int positions(const std::vector<Vec3>& v) {
        const int a = vec3s(v);
        Vec3 low = v.front(), high = v.front();
        for (const Vec3& p : v) low = glm::min(low, p), high = glm::max(high, p);
        model_.accessors[std::size_t(a)].minValues = {low.x, low.y, low.z};
        model_.accessors[std::size_t(a)].maxValues = {high.x, high.y, high.z};
        return a;
    }

  private:
    template <class T>
    int attribute(const std::vector<T>& v, int type) {
        return accessor(v, TINYGLTF_COMPONENT_TYPE_FLOAT, type, TINYGLTF_TARGET_ARRAY_BUFFER);
    }
    tinygltf::Model& model_;
};

Value number(double v) {
    return Value(v);
}
Value object(Value::Object members) {
    return Value(std::move(members));
}

// Per-vertex tangents along increasing u, orthogonal to the normal (Lengyel 2001).
std::vector<Vec4> tangents(const Geometry& g, const std::vector<Vec2>& uvs) {
    std::vector<Vec3> along_u(g.positions.size(), Vec3(0)), along_v(g.positions.size(), Vec3(0));
    for (std::size_t i = 0; i + 2 < g.indices.size(); i += 3) {
        const std::uint32_t a = g.indices[i], b = g.indices[i + 1], c = g.indices[i + 2];
        const Vec3 e1 = g.positions[b] - g.positions[a], e2 = g.positions[c] - g.positions[a];
        const Vec2 d1 = uvs[b] - uvs[a], d2 = uvs[c] - uvs[a];
        const float det = d1.x * d2.y - d2.x * d1.y;
        if (std::abs(det) < 1e-20f) continue;
        const Vec3 t = (e1 * d2.y - e2 * d1.y) / det, s = (e2 * d1.x - e1 * d2.x) / det;
        for (std::uint32_t k : {a, b, c}) along_u[k] += t, along_v[k] += s;
    }
    std::vector<Vec4> result;
    for (std::size_t i = 0; i < g.positions.size(); ++i) {
        const Vec3 n = g.normals[i];
        Vec3 t = along_u[i] - n * glm::dot(n, along_u[i]);
        if (glm::dot(t, t) < 1e-20f) t = glm::cross(n, std::abs(n.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0));
        t = glm::normalize(t);
        // v grows downwards in a picture while the normal map's green points up, hence the sign.
        result.emplace_back(t, glm::dot(glm::cross(n, t), along_v[i]) > 0.0f ? -1.0f : 1.0f);
    }
    return result;
}

tinygltf::Primitive primitive(Buffer& buffer, const Geometry& g, int material, const Surface& surface) {
    std::vector<Vec2> uvs = g.uvs;
    for (Vec2& uv : uvs) uv /= surface.tile;
    tinygltf::Primitive p;
    p.mode = TINYGLTF_MODE_TRIANGLES;
    p.material = material;
    p.indices = buffer.accessor(g.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    p.attributes["POSITION"] = buffer.positions(g.positions);
    p.attributes["NORMAL"] = buffer.vec3s(g.normals);
    if (surface.color_picture >= 0 || surface.normal_picture >= 0 || surface.roughness_picture >= 0)
        p.attributes["TEXCOORD_0"] = buffer.vec2s(uvs);
    if (surface.normal_picture >= 0) p.attributes["TANGENT"] = buffer.vec4s(tangents(g, uvs));
    if (!g.joints.empty()) {
        p.attributes["JOINTS_0"] = buffer.accessor(g.joints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                                                   TINYGLTF_TARGET_ARRAY_BUFFER);
        p.attributes["WEIGHTS_0"] = buffer.vec4s(g.weights);
    }
    return p;
}

Value evening_extras() {
    return object({{"daylit", object({{"lit", Value(std::string("evening"))}})}});
}

tinygltf::Material material(const Surface& s) {
    tinygltf::Material m;
    m.name = s.name;
    m.pbrMetallicRoughness.baseColorFactor = {s.color.r, s.color.g, s.color.b, s.alpha};
    m.pbrMetallicRoughness.metallicFactor = s.metallic;
    m.pbrMetallicRoughness.roughnessFactor = s.roughness;
    m.pbrMetallicRoughness.baseColorTexture.index = s.color_picture;
    m.pbrMetallicRoughness.metallicRoughnessTexture.index = s.roughness_picture;
    m.normalTexture.index = s.normal_picture;
    m.normalTexture.scale = s.normal_scale;
    m.doubleSided = s.double_sided;
    m.alphaMode = s.alpha_mode == AlphaMode::Opaque ? "OPAQUE" : s.alpha_mode == AlphaMode::Mask ? "MASK" : "BLEND";
    const float peak = std::max({s.emission.r, s.emission.g, s.emission.b});
    if (peak > 0.0f) {
        m.emissiveFactor = {s.emission.r / peak, s.emission.g / peak, s.emission.b / peak};
        m.extensions["KHR_materials_emissive_strength"] = object({{"emissiveStrength", number(peak)}});
    }
    if (s.lit == Lit::Evening) m.extras = evening_extras();
    if (s.transmission > 0.0f) {
        m.extensions["KHR_materials_transmission"] = object({{"transmissionFactor", number(s.transmission)}});
        m.extensions["KHR_materials_ior"] = object({{"ior", number(s.ior)}});
    }
    if (s.specular != 1.0f) m.extensions["KHR_materials_specular"] = object({{"specularFactor", number(s.specular)}});
    return m;
}

tinygltf::Node node(const LevelNode& n) {
    tinygltf::Node out;
    out.name = n.name;
    out.mesh = n.mesh;
    out.skin = n.skin;
    out.camera = n.camera;
    out.children = n.children;
    if (n.translation != Vec3(0.0f)) out.translation = {n.translation.x, n.translation.y, n.translation.z};
    if (n.rotation != Quat(1, 0, 0, 0)) out.rotation = {n.rotation.x, n.rotation.y, n.rotation.z, n.rotation.w};
    if (n.scale != Vec3(1.0f)) out.scale = {n.scale.x, n.scale.y, n.scale.z};
    if (n.light >= 0) out.extensions["KHR_lights_punctual"] = object({{"light", Value(n.light)}});
    if (n.dynamic) out.extras = object({{"daylit", object({{"dynamic", Value(true)}})}});
    return out;
}

tinygltf::Light light(const Lamp& lamp) {
    tinygltf::Light l;
    l.name = lamp.name;
    const double peak = std::max({lamp.intensity.r, lamp.intensity.g, lamp.intensity.b});
    l.color = {lamp.intensity.r / peak, lamp.intensity.g / peak, lamp.intensity.b / peak};
    l.intensity = peak;
    if (lamp.lit == Lit::Evening) l.extras = evening_extras();
    l.type = lamp.outer_cone > 0.0f ? "spot" : "point";
    if (lamp.outer_cone > 0.0f) {
        l.spot.innerConeAngle = lamp.inner_cone;
        l.spot.outerConeAngle = lamp.outer_cone;
    }
    return l;
}

tinygltf::Animation animation(Buffer& buffer, const LevelAnimation& a) {
    tinygltf::Animation out;
    out.name = a.name;
    for (const LevelChannel& channel : a.channels) {
        tinygltf::AnimationSampler sampler;
        sampler.interpolation = "LINEAR";
        sampler.input = buffer.floats(channel.times);
        if (channel.path == AnimationPath::Rotation) {
            sampler.output = buffer.accessor(channel.values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4);
        } else {
            std::vector<Vec3> values(channel.values.begin(), channel.values.end());
            sampler.output = buffer.accessor(values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
        }
        tinygltf::AnimationChannel c;
        c.sampler = int(out.samplers.size());
        c.target_node = channel.node;
        c.target_path = channel.path == AnimationPath::Rotation ? "rotation"
                        : channel.path == AnimationPath::Scale  ? "scale"
                                                                : "translation";
        out.samplers.push_back(sampler);
        out.channels.push_back(c);
    }
    return out;
}

Value day_extras(const Day& day) {
    char date[32];
    std::snprintf(date, sizeof date, "%04d-%02d-%02d", day.date.year, day.date.month, day.date.day);
    Value::Object members{{"latitude", number(day.latitude)},
                          {"longitude", number(day.longitude)},
                          {"date", Value(std::string(date))},
                          {"utc_offset", number(day.utc_offset)}};
    if (day.north != 0.0) members["north"] = number(day.north);
    return object({{"daylit", object(std::move(members))}});
}

void add_pictures(tinygltf::Model& model, Buffer& buffer, const Level& level) {
    tinygltf::Sampler sampler;
    sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
    sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    if (!level.pictures.empty()) model.samplers.push_back(sampler);
    for (const Picture& picture : level.pictures) {
        tinygltf::Image image;
        image.name = picture.name;
        image.mimeType = "image/png";
        image.bufferView = buffer.view(picture.png.data(), picture.png.size(), 0);
        model.images.push_back(image);
        tinygltf::Texture texture;
        texture.name = picture.name;
        texture.sampler = 0;
        texture.source = int(model.images.size()) - 1;
        model.textures.push_back(texture);
    }
}

std::vector<std::string> used_extensions(const Level& level) {
    bool strength = false, glass = false, specular = false;
    for (const Surface& s : level.surfaces) {
        strength |= s.emission != Rgb(0.0f);
        glass |= s.transmission > 0.0f;
        specular |= s.specular != 1.0f;
    }
    std::vector<std::string> names;
    if (!level.lamps.empty()) names.emplace_back("KHR_lights_punctual");
    if (strength) names.emplace_back("KHR_materials_emissive_strength");
    if (glass) names.insert(names.end(), {"KHR_materials_ior", "KHR_materials_transmission"});
    if (specular) names.emplace_back("KHR_materials_specular");
    return names;
}

tinygltf::Model to_gltf(const Level& level) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "daylit make " + level.name;
    Buffer buffer(model);
    add_pictures(model, buffer, level);
    for (const Surface& surface : level.surfaces) model.materials.push_back(material(surface));
    for (const LevelMesh& mesh : level.meshes) {
        tinygltf::Mesh out;
        out.name = mesh.name;
        for (const auto& [index, geometry] : mesh.parts)
            if (!geometry.indices.empty())
                out.primitives.push_back(primitive(buffer, geometry, index, level.surfaces[std::size_t(index)]));
        model.meshes.push_back(out);
    }
    for (const LevelCamera& camera : level.cameras) {
        tinygltf::Camera out;
        out.type = "perspective";
        out.perspective.yfov = camera.vertical_fov_deg * kDegree;
        out.perspective.aspectRatio = 16.0 / 9.0;
        out.perspective.znear = camera.z_near;
        model.cameras.push_back(out);
    }
    for (const Lamp& lamp : level.lamps) model.lights.push_back(light(lamp));
    for (const LevelNode& n : level.nodes) model.nodes.push_back(node(n));
    for (const LevelSkin& skin : level.skins) {
        tinygltf::Skin out;
        out.name = skin.name;
        out.joints = skin.joints;
        out.inverseBindMatrices =
            buffer.accessor(skin.joint_from_mesh, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4);
        model.skins.push_back(out);
    }
    for (const LevelAnimation& a : level.animations) model.animations.push_back(animation(buffer, a));
    tinygltf::Scene scene;
    scene.name = level.name;
    scene.nodes = level.roots;
    if (level.day) scene.extras = day_extras(*level.day);
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    model.extensionsUsed = used_extensions(level);
    return model;
}

}  // namespace

void write_glb(const Level& level, const std::filesystem::path& path) {
    const tinygltf::Model model = to_gltf(level);
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, stream, false, true))
        throw Error(path.string(), "the level could not be put into a binary glTF");
    const std::string bytes = std::move(stream).str();
    write_file(path, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

}  // namespace daylit::content
