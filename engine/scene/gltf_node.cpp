// The node tree with cameras, lights, skins, instances and extras.daylit.
#include <algorithm>
#include <cmath>

#include "engine/scene/gltf.h"
#include "engine/scene/gltf_file.h"
#include "engine/scene/pose.h"

namespace daylit::gltf {
namespace {

using tinygltf::Value;

// World meshes hold about 100 bytes a vertex; a few lines of JSON can place one mesh any number of times.
constexpr std::uint64_t kMaxPlacedVertices = std::uint64_t(1) << 26;

int default_scene(const File& file) {
    if (file.model.defaultScene != -1) {
        if (!in_range(file.model.defaultScene, file.model.scenes))
            file.fail("scene", std::to_string(file.model.defaultScene) + " does not exist");
        return file.model.defaultScene;
    }
    return file.model.scenes.empty() ? -1 : 0;
}

std::optional<glm::ivec2> read_lightmap_size(File& file, const Value& extras) {
    if (!extras.Has("lightmap")) return {};
    constexpr int kMost = 1 << 16;
    const Value& value = extras.Get("lightmap");
    glm::ivec2 size(0);
    for (int k = 0; value.IsArray() && value.ArrayLen() == 2 && k < 2; ++k)
        if (value.Get(std::size_t(k)).IsInt()) size[k] = value.Get(std::size_t(k)).GetNumberAsInt();
    if (size.x < 1 || size.y < 1 || size.x > kMost || size.y > kMost)
        file.fail("extras.daylit.lightmap", "must be [width, height] in texels, 1 to 65536 each");
    return size;
}

std::optional<Date> read_date(File& file, const Value& extras) {
    if (!extras.Has("date")) return {};
    Date date;
    char rest = 0;
    const Value& value = extras.Get("date");
    if (!value.IsString() ||
        std::sscanf(value.Get<std::string>().c_str(), "%d-%d-%d%c", &date.year, &date.month, &date.day, &rest) != 3 ||
        date.month < 1 || date.month > 12 || date.day < 1 || date.day > 31)
        file.fail("extras.daylit.date", "must be \"YYYY-MM-DD\"");
    return date;
}

template <int N>
glm::vec<N, float> vector_of(const File& file, const std::vector<double>& values, glm::vec<N, float> otherwise,
                             const std::string& where) {
    if (values.empty()) return otherwise;
    if (values.size() != std::size_t(N)) file.fail(where, "must have " + std::to_string(N) + " numbers");
    for (int i = 0; i < N; ++i) otherwise[i] = file.number(values[std::size_t(i)], where);
    return otherwise;
}

void read_transform(File& file, const tinygltf::Node& in, Node& node, const std::string& where) {
    if (!in.matrix.empty()) {
        if (in.matrix.size() != 16) file.fail(where + " matrix", "must have 16 numbers");
        Mat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = file.number(in.matrix[std::size_t(i)], where + " matrix");
        if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
            file.fail(where + " matrix", "is not affine: its last row must be 0, 0, 0, 1");
        matrix[3] = Vec4(Vec3(matrix[3]) * file.unit, 1.0f);
        if (matrix != Mat4(1.0f)) node.matrix = matrix;
        return;
    }
    node.translation = vector_of<3>(file, in.translation, Vec3(0), where + " translation") * file.unit;
    node.scale = vector_of<3>(file, in.scale, Vec3(1), where + " scale");
    const Vec4 q = vector_of<4>(file, in.rotation, Vec4(0, 0, 0, 1), where + " rotation");
    const float length = glm::length(q);
    if (!(length > 1e-6f) || !std::isfinite(length)) {
        file.note(where, "has a rotation of no length; none is taken");
        return;
    }
    if (std::abs(length - 1.0f) > 1e-2f) file.note(where, "has a rotation that is no unit quaternion; normalised");
    node.rotation = Quat(q.w / length, q.x / length, q.y / length, q.z / length);
}

void link_children(File& file, Scene& scene) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const tinygltf::Node& in = file.model.nodes[i];
        const std::string where = place("node", i, in.name);
        for (const int child : in.children) {
            if (!in_range(child, scene.nodes))
                file.fail(where, "has the child " + std::to_string(child) + ", which does not exist");
            if (scene.nodes[std::size_t(child)].parent != -1)
                file.fail(place("node", std::size_t(child)), "is the child of two nodes");
            scene.nodes[std::size_t(child)].parent = int(i);
            scene.nodes[i].children.push_back(child);
        }
    }
}

/// With one parent a node at most, a node that no walk from a parentless node reaches is on a cycle or below one.
void check_cycles(const File& file, const Scene& scene) {
    std::vector<int> reached;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].parent == -1) reached.push_back(int(i));
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const int child : scene.nodes[std::size_t(reached[i])].children) reached.push_back(child);
    if (reached.size() == scene.nodes.size()) return;
    std::vector<bool> seen(scene.nodes.size(), false);
    for (const int node : reached) seen[std::size_t(node)] = true;
    const auto lost = std::size_t(std::find(seen.begin(), seen.end(), false) - seen.begin());
    file.fail(place("node", lost, scene.nodes[lost].name), "is its own descendant or below such a node");
}

std::vector<int> root_nodes(File& file, const Scene& scene) {
    const int chosen = default_scene(file);
    if (chosen >= 0) return file.model.scenes[std::size_t(chosen)].nodes;
    std::vector<int> roots;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].parent == -1) roots.push_back(int(i));
    if (!roots.empty()) file.note("file", "has no scene; all its nodes are taken");
    return roots;
}

/// Depth first, children in the file's order, without recursion: trees may be as deep as the file is long.
void order_nodes(File& file, Scene& scene) {
    std::vector<int> waiting;
    std::vector<bool> listed(scene.nodes.size(), false);
    for (const int root : root_nodes(file, scene)) {
        if (!in_range(root, scene.nodes))
            file.fail("scene", "lists node " + std::to_string(root) + ", which does not exist");
        if (scene.nodes[std::size_t(root)].parent != -1)
            file.fail(place("node", std::size_t(root)), "is listed by the scene but is the child of another node");
        if (listed[std::size_t(root)]) {
            file.note(place("node", std::size_t(root)), "is listed twice by the scene");
            continue;
        }
        listed[std::size_t(root)] = true;
        waiting.push_back(root);
        while (!waiting.empty()) {
            const int node = waiting.back();
            waiting.pop_back();
            scene.order.push_back(node);
            const std::vector<int>& children = scene.nodes[std::size_t(node)].children;
            waiting.insert(waiting.end(), children.rbegin(), children.rend());
        }
    }
}

void read_camera(File& file, Scene& scene, int node, int index, const std::string& where) {
    if (!in_range(index, file.model.cameras))
        file.fail(where, "refers to camera " + std::to_string(index) + ", which does not exist");
    const tinygltf::Camera& in = file.model.cameras[std::size_t(index)];
    const std::string at = place("camera", std::size_t(index), in.name);
    Camera camera;
    camera.node = node;
    camera.name = scene.nodes[std::size_t(node)].name;
    if (camera.name.empty()) camera.name = in.name;
    if (camera.name.empty()) camera.name = "camera" + std::to_string(index);
    camera.orthographic = in.type == "orthographic";
    const double z_near = camera.orthographic ? in.orthographic.znear : in.perspective.znear;
    const double z_far = camera.orthographic ? in.orthographic.zfar : in.perspective.zfar;
    if (z_far != 0 && !(z_far > z_near))
        file.note(at, "has a far plane before its near plane; it is taken as infinite");
    camera.z_far = z_far > z_near ? file.number(z_far * file.unit, at) : 0.0f;
    camera.z_near = std::max(file.number(z_near * file.unit, at), 0.0f);
    if (camera.orthographic) {
        camera.height = 2 * std::abs(file.number(in.orthographic.ymag * file.unit, at));
        if (!(camera.height > 0)) file.fail(at, "has no height (ymag)");
    } else {
        camera.vertical_fov = file.number(in.perspective.yfov, at);
        if (!(camera.vertical_fov > 0 && camera.vertical_fov < kPi))
            file.fail(at, "has a vertical angle of view (yfov) outside 0 to pi");
        if (camera.z_near <= 0) {
            file.note(at, "has no near plane; 0.05 m is taken");
            camera.z_near = 0.05f;
        }
    }
    scene.nodes[std::size_t(node)].camera = int(scene.cameras.size());
    scene.cameras.push_back(camera);
}

void read_spot(File& file, const tinygltf::Light& in, PunctualLight& light, const std::string& at) {
    light.inner_cone = file.number(in.spot.innerConeAngle, at);
    light.outer_cone = file.number(in.spot.outerConeAngle, at);
    const float half_pi = float(kPi / 2);
    const bool fine = light.inner_cone >= 0 && light.inner_cone < light.outer_cone && light.outer_cone <= half_pi;
    if (fine) return;
    file.note(at, "has cone angles out of order or range; they are clamped");
    light.outer_cone = std::clamp(light.outer_cone, 1e-3f, half_pi);
    light.inner_cone = std::clamp(light.inner_cone, 0.0f, light.outer_cone);
}

void read_light(File& file, Scene& scene, int node, int index, const std::string& where) {
    if (!in_range(index, file.model.lights))
        file.fail(where, "refers to light " + std::to_string(index) + ", which does not exist");
    const tinygltf::Light& in = file.model.lights[std::size_t(index)];
    const std::string at = place("light", std::size_t(index), in.name);
    PunctualLight light;
    light.node = node;
    light.name = scene.nodes[std::size_t(node)].name.empty() ? in.name : scene.nodes[std::size_t(node)].name;
    if (in.type == "directional") {
        light.kind = LightKind::Directional;
    } else if (in.type == "spot") {
        light.kind = LightKind::Spot;
        read_spot(file, in, light, at);
    } else if (in.type != "point") {
        return file.note(at, "is of the unknown type '" + in.type + "'; ignored");
    }
    const Vec3 color = vector_of<3>(file, in.color, Rgb(1.0f), at + " color");
    light.intensity = color * file.number(in.intensity, at + " intensity");
    for (int c = 0; c < 3; ++c) {
        if (!std::isfinite(light.intensity[c])) file.fail(at, "is brighter than a float can hold");
        if (light.intensity[c] < 0) {
            file.note(at, "has negative intensity; 0 is taken");
            light.intensity[c] = 0;
        }
    }
    light.range = std::max(file.number(in.range * file.unit, at + " range"), 0.0f);
    light.lit = read_lit(file, in.extras, at);
    scene.nodes[std::size_t(node)].light = int(scene.lights.size());
    scene.lights.push_back(light);
}

/// The light of a node, which tinygltf 2.7 leaves in the extension.
int light_of(File& file, const tinygltf::Node& in, const std::string& where) {
    const auto found = in.extensions.find("KHR_lights_punctual");
    if (found == in.extensions.end()) return -1;
    if (!found->second.IsObject() || !found->second.Has("light") || !found->second.Get("light").IsInt())
        file.fail(where + " KHR_lights_punctual", "names no light");
    return found->second.Get("light").GetNumberAsInt();
}

void read_instances(File& file, const tinygltf::Node& in, Node& node, const std::string& where) {
    const auto found = in.extensions.find("EXT_mesh_gpu_instancing");
    if (found == in.extensions.end() || node.mesh == -1) return;
    const Value attributes = found->second.IsObject() ? found->second.Get("attributes") : Value();
    const auto read = [&](const char* name, int components) -> std::vector<float> {
        if (!attributes.IsObject() || !attributes.Has(name)) return {};
        const std::string at = where + " instances " + name;
        const int accessor = attributes.Get(name).IsInt() ? attributes.Get(name).GetNumberAsInt() : -1;
        if (check_accessor(file, accessor, at).components != components) file.fail(at, "is of the wrong type");
        return read_floats(file, accessor, at);
    };
    const std::vector<Vec3> translations = grouped<Vec3>(read("TRANSLATION", 3)),
                            scales = grouped<Vec3>(read("SCALE", 3));
    const std::vector<Vec4> rotations = grouped<Vec4>(read("ROTATION", 4));
    const std::size_t count = std::max({translations.size(), scales.size(), rotations.size()});
    for (const std::size_t size : {translations.size(), scales.size(), rotations.size()})
        if (size != 0 && size != count) file.fail(where, "has instance attributes of unequal counts");
    if (count == 0) return file.note(where, "has an instancing extension without attributes; drawn once");
    file.charge(count * sizeof(Mat4), where);
    for (std::size_t i = 0; i < count; ++i) {
        Mat4 matrix(1.0f);
        if (!rotations.empty()) {
            const Vec4 q = rotations[i];
            if (!(glm::length(q) > 1e-6f)) file.fail(where, "has an instance with a rotation of no length");
            matrix = glm::mat4_cast(glm::normalize(Quat(q.w, q.x, q.y, q.z)));
        }
        if (!scales.empty())
            for (int c = 0; c < 3; ++c) matrix[c] *= scales[i][c];
        if (!translations.empty()) matrix[3] = Vec4(translations[i] * file.unit, 1.0f);
        node.instances.push_back(matrix);
    }
}

void read_skins(File& file, Scene& scene) {
    for (std::size_t s = 0; s < file.model.skins.size(); ++s) {
        const tinygltf::Skin& in = file.model.skins[s];
        const std::string where = place("skin", s, in.name);
        Skin skin;
        skin.joints = in.joints;
        if (skin.joints.empty()) file.fail(where, "has no joints");
        for (const int joint : skin.joints)
            if (!in_range(joint, scene.nodes))
                file.fail(where, "refers to node " + std::to_string(joint) + ", which does not exist");
        skin.joint_from_mesh.assign(skin.joints.size(), Mat4(1.0f));
        if (in.inverseBindMatrices != -1) {
            const std::string at = where + " inverseBindMatrices";
            const AccessorShape shape = check_accessor(file, in.inverseBindMatrices, at);
            if (shape.components != 16 || shape.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT)
                file.fail(at, "must be 4 x 4 matrices of floats");
            if (shape.count < skin.joints.size()) file.fail(at, "are fewer than the joints");
            const std::vector<float> values = read_floats(file, in.inverseBindMatrices, at);
            for (std::size_t j = 0; j < skin.joints.size(); ++j) {
                Mat4& matrix = skin.joint_from_mesh[j];
                for (std::size_t i = 0; i < 16; ++i) matrix[int(i / 4)][int(i % 4)] = values[16 * j + i];
                if (matrix[0][3] != 0 || matrix[1][3] != 0 || matrix[2][3] != 0 || matrix[3][3] != 1)
                    file.note(at, "hold a matrix that is not affine; its last row is taken as 0, 0, 0, 1");
                matrix[0][3] = matrix[1][3] = matrix[2][3] = 0.0f;
                matrix[3] = Vec4(Vec3(matrix[3]) * file.unit, 1.0f);
            }
        }
        scene.skins.push_back(std::move(skin));
    }
}

void read_node(File& file, const tinygltf::Node& in, Node& node, const Scene& scene, const std::string& where) {
    node.name = in.name;
    read_transform(file, in, node, where);
    node.mesh = in.mesh;
    if (node.mesh != -1 && !in_range(node.mesh, scene.meshes))
        file.fail(where, "refers to mesh " + std::to_string(node.mesh) + ", which does not exist");
    node.skin = in.skin;
    if (node.skin != -1 && !in_range(node.skin, scene.skins))
        file.fail(where, "refers to skin " + std::to_string(node.skin) + ", which does not exist");
    for (const double weight : in.weights) node.morph_weights.push_back(file.number(weight, where + " weights"));
    const std::size_t targets = node.mesh == -1 ? 0 : scene.meshes[std::size_t(node.mesh)].morph_weights.size();
    if (!node.morph_weights.empty() && node.morph_weights.size() != targets) {
        file.note(where, "has weights for another number of morph targets than its mesh; ignored");
        node.morph_weights.clear();
    }
    read_instances(file, in, node, where);
    if (const Value* extras = daylit_extras(in.extras); extras && extras->Has("dynamic"))
        node.dynamic = extras->Get("dynamic").IsBool() && extras->Get("dynamic").Get<bool>();
}

void check_joints(const File& file, const Scene& scene, const Node& node, const std::string& where) {
    if (node.skin == -1 || node.mesh == -1) return;
    const std::size_t joints = scene.skins[std::size_t(node.skin)].joints.size();
    for (const Primitive& primitive : scene.meshes[std::size_t(node.mesh)].primitives)
        for (const auto& four : primitive.joints)
            for (const std::uint16_t joint : four)
                if (joint >= joints)
                    file.fail(where, "has vertices that follow joint " + std::to_string(joint) + " of a skin with " +
                                         std::to_string(joints));
}

/// Dynamic passes down the tree and from joints to what they move.
void mark_dynamic(Scene& scene) {
    for (const Animation& animation : scene.animations)
        for (const AnimationChannel& channel : animation.channels)
            scene.nodes[std::size_t(channel.node)].dynamic = true;
    const auto pass_down = [&] {
        for (const int node : scene.order)
            if (const int parent = scene.nodes[std::size_t(node)].parent; parent != -1)
                scene.nodes[std::size_t(node)].dynamic |= scene.nodes[std::size_t(parent)].dynamic;
    };
    pass_down();
    for (Node& node : scene.nodes)
        if (node.skin != -1)
            for (const int joint : scene.skins[std::size_t(node.skin)].joints)
                node.dynamic |= scene.nodes[std::size_t(joint)].dynamic;
    pass_down();
}

void check_counts(const File& file, const Scene& scene) {
    std::uint64_t placed = 0;
    for (const int n : scene.order) {
        const Node& node = scene.nodes[std::size_t(n)];
        if (node.mesh == -1) continue;
        for (const Primitive& primitive : scene.meshes[std::size_t(node.mesh)].primitives)
            placed += std::max<std::uint64_t>(primitive.positions.size(), primitive.indices.size()) *
                      std::max<std::uint64_t>(node.instances.size(), 1);
        if (placed > kMaxPlacedVertices)
            file.fail(place("node", std::size_t(n), node.name),
                      "brings the level beyond 67 million corners of triangles");
    }
}

/// At the rest pose; animations and moves start from there.
void check_extent(const File& file, const Scene& scene) {
    const Pose pose = pose_scene(scene);
    for (const int n : scene.order) {
        const Node& node = scene.nodes[std::size_t(n)];
        const std::string where = place("node", std::size_t(n), node.name);
        const Mat4& matrix = pose.world_from_node[std::size_t(n)];
        const auto inside = [&](const Vec3& p) {
            const Vec3 world = Vec3(matrix * Vec4(p, 1.0f));
            return std::abs(world.x) <= kMaxCoordinate && std::abs(world.y) <= kMaxCoordinate &&
                   std::abs(world.z) <= kMaxCoordinate;
        };
        const auto check = [&](const Vec3& p) {
            if (!inside(p)) file.fail(where, "lies more than 1e8 m from the origin; check the unit and the transforms");
        };
        check(Vec3(0.0f));
        if (node.mesh == -1) continue;
        for (const Primitive& primitive : scene.meshes[std::size_t(node.mesh)].primitives)
            for (const Vec3& p : primitive.positions) {
                check(p);
                for (const Mat4& instance : node.instances) {
                    if (&p != &primitive.positions.front()) break;  // instances: their first corner stands for all
                    check(Vec3(instance * Vec4(p, 1.0f)));
                }
            }
    }
}

void note_unused_accessors(File& file) {
    file.used_accessors.resize(file.model.accessors.size(), false);
    const auto unused = std::count(file.used_accessors.begin(), file.used_accessors.end(), false);
    if (unused == 0) return;
    const auto first =
        std::find(file.used_accessors.begin(), file.used_accessors.end(), false) - file.used_accessors.begin();
    file.note("file", "has " + std::to_string(unused) + " accessors of no use (the first is " + std::to_string(first) +
                          "); not read");
}

}  // namespace

const Value* daylit_extras(const Value& extras) {
    if (!extras.IsObject() || !extras.Has("daylit") || !extras.Get("daylit").IsObject()) return nullptr;
    return &extras.Get("daylit");
}

Lit read_lit(File& file, const Value& extras, const std::string& where) {
    const Value* values = daylit_extras(extras);
    if (!values || !values->Has("lit")) return Lit::Always;
    const Value& value = values->Get("lit");
    const std::string word = value.IsString() ? value.Get<std::string>() : "";
    if (word == "evening") return Lit::Evening;
    if (word != "always")
        file.note(where + " extras.daylit.lit", "is neither \"always\" nor \"evening\"; always is taken");
    return Lit::Always;
}

SceneExtras read_extras(File& file) {
    SceneExtras extras;
    const int chosen = default_scene(file);
    if (chosen < 0) return extras;
    const Value* values = daylit_extras(file.model.scenes[std::size_t(chosen)].extras);
    if (!values) return extras;
    const auto number = [&](const char* key, double low, double high) -> std::optional<double> {
        if (!values->Has(key)) return {};
        const Value& value = values->Get(key);
        const std::string where = std::string("extras.daylit.") + key;
        if (!value.IsNumber()) file.fail(where, "must be a number");
        const double x = value.GetNumberAsDouble();
        if (!(x >= low && x <= high))
            file.fail(where,
                      "is " + std::to_string(x) + ", outside " + std::to_string(low) + " to " + std::to_string(high));
        return x;
    };
    extras.latitude = number("latitude", -90, 90);
    extras.longitude = number("longitude", -180, 180);
    extras.utc_offset = number("utc_offset", -14, 14);
    extras.north = number("north", -360, 360);
    extras.turbidity = number("turbidity", 1, 10);
    extras.clouds = number("clouds", 0, 1);
    extras.unit = number("unit", 1e-6, 1e6);
    extras.date = read_date(file, *values);
    extras.lightmap = read_lightmap_size(file, *values);
    return extras;
}

void read_nodes(File& file, Scene& scene) {
    scene.nodes.resize(file.model.nodes.size());
    read_skins(file, scene);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        read_node(file, file.model.nodes[i], scene.nodes[i], scene, place("node", i, file.model.nodes[i].name));
    link_children(file, scene);
    check_cycles(file, scene);
    order_nodes(file, scene);
    for (const int node : scene.order) {
        const tinygltf::Node& in = file.model.nodes[std::size_t(node)];
        const std::string where = place("node", std::size_t(node), in.name);
        if (in.camera != -1) read_camera(file, scene, node, in.camera, where);
        if (const int light = light_of(file, in, where); light != -1) read_light(file, scene, node, light, where);
    }
}

void check_placement(File& file, Scene& scene) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        Node& node = scene.nodes[i];
        const std::string where = place("node", i, node.name);
        if (node.skin != -1 && node.mesh == -1) file.note(where, "has a skin but no mesh");
        check_joints(file, scene, node, where);
    }
    mark_dynamic(scene);
    check_counts(file, scene);
    check_extent(file, scene);
    note_unused_accessors(file);
}

}  // namespace daylit::gltf
