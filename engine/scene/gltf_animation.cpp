// Animations; a channel that cannot be played is dropped with a note, one that cannot be read is refused.
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/scene/gltf_file.h"

namespace daylit::gltf {
namespace {

std::optional<AnimationPath> animation_path(const std::string& name) {
    if (name == "translation") return AnimationPath::Translation;
    if (name == "rotation") return AnimationPath::Rotation;
    if (name == "scale") return AnimationPath::Scale;
    if (name == "weights") return AnimationPath::Weights;
    return {};
}

Interpolation interpolation(File& file, const std::string& name, const std::string& where) {
    if (name == "STEP") return Interpolation::Step;
    if (name == "CUBICSPLINE") return Interpolation::CubicSpline;
    if (name != "LINEAR" && !name.empty())
        file.note(where, "has the unknown interpolation '" + name + "'; LINEAR is taken");
    return Interpolation::Linear;
}

/// Components of one key as an accessor has them, and how many accessor elements make one key.
struct KeyShape {
    int components = 1;
    std::size_t elements = 1;
};

KeyShape key_shape(const Scene& scene, const AnimationChannel& channel) {
    switch (channel.path) {
        case AnimationPath::Rotation:
            return {4, 1};
        case AnimationPath::Weights: {
            const int mesh = scene.nodes[std::size_t(channel.node)].mesh;
            return {1, mesh == -1 ? 0 : scene.meshes[std::size_t(mesh)].morph_weights.size()};
        }
        default:
            return {3, 1};
    }
}

bool ascends(const std::vector<float>& times) {
    return times.front() >= 0 && std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
}

/// Quaternions to unit length; those of CubicSpline are normalised after interpolation.
bool normalize_rotations(std::vector<float>& values) {
    for (std::size_t i = 0; i < values.size(); i += 4) {
        const float length = glm::length(Vec4(values[i], values[i + 1], values[i + 2], values[i + 3]));
        if (!(length > 1e-6f) || !std::isfinite(length)) return false;
        for (std::size_t c = 0; c < 4; ++c) values[i + c] /= length;
    }
    return true;
}

std::vector<float> read_keys(File& file, const Scene& scene, const AnimationChannel& channel, int output,
                             const std::string& where) {
    const KeyShape key = key_shape(scene, channel);
    const AccessorShape shape = check_accessor(file, output, where);
    const std::size_t per_key = key.elements * (channel.interpolation == Interpolation::CubicSpline ? 3 : 1);
    if (shape.components != key.components) file.fail(where, "has the wrong type for what it animates");
    if (shape.count != channel.times.size() * per_key)
        file.fail(where, "has " + std::to_string(shape.count) + " elements for " +
                             std::to_string(channel.times.size()) + " times");
    return read_floats(file, output, where);
}

/// Empty (with a note) when the channel cannot be played.
std::optional<AnimationChannel> read_channel(File& file, const Scene& scene, const tinygltf::Animation& animation,
                                             const tinygltf::AnimationChannel& in, const std::string& where) {
    const auto dropped = [&](const char* why) {
        file.note(where, std::string(why) + "; dropped");
        return std::nullopt;
    };
    if (!in_range(in.sampler, animation.samplers))
        file.fail(where, "refers to sampler " + std::to_string(in.sampler) + ", which does not exist");
    const tinygltf::AnimationSampler& sampler = animation.samplers[std::size_t(in.sampler)];
    const std::optional<AnimationPath> path = animation_path(in.target_path);
    if (!path) return dropped("animates something else than a node's place, turn, size or weights");
    if (in.target_node == -1) return dropped("names no node");
    if (!in_range(in.target_node, scene.nodes))
        file.fail(where, "refers to node " + std::to_string(in.target_node) + ", which does not exist");
    AnimationChannel channel;
    channel.node = in.target_node;
    channel.path = *path;
    channel.interpolation = interpolation(file, sampler.interpolation, where);
    const Node& node = scene.nodes[std::size_t(channel.node)];
    if (node.matrix && channel.path != AnimationPath::Weights) return dropped("animates a node that has a matrix");
    if (channel.path == AnimationPath::Weights && key_shape(scene, channel).elements == 0)
        return dropped("animates weights of a node without morph targets");
    const AccessorShape times = check_accessor(file, sampler.input, where + " input");
    if (times.components != 1 || times.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT)
        file.fail(where + " input", "must be scalar floats");
    channel.times = read_floats(file, sampler.input, where + " input");
    if (!ascends(channel.times)) return dropped("has times that do not ascend from 0 or later");
    channel.values = read_keys(file, scene, channel, sampler.output, where + " output");
    if (channel.path == AnimationPath::Translation)
        for (float& value : channel.values) value *= file.unit;
    if (channel.path == AnimationPath::Rotation && channel.interpolation != Interpolation::CubicSpline &&
        !normalize_rotations(channel.values))
        return dropped("has rotations of no length");
    return channel;
}

}  // namespace

void read_animations(File& file, Scene& scene) {
    for (std::size_t a = 0; a < file.model.animations.size(); ++a) {
        const tinygltf::Animation& in = file.model.animations[a];
        const std::string where = place("animation", a, in.name);
        Animation animation;
        animation.name = in.name;
        for (std::size_t c = 0; c < in.channels.size(); ++c)
            if (auto channel = read_channel(file, scene, in, in.channels[c], where + " channel " + std::to_string(c))) {
                animation.duration = std::max(animation.duration, channel->times.back());
                animation.channels.push_back(std::move(*channel));
            }
        for (std::size_t s = 0; s < in.samplers.size(); ++s) {
            check_accessor(file, in.samplers[s].input, where + " sampler " + std::to_string(s) + " input");
            check_accessor(file, in.samplers[s].output, where + " sampler " + std::to_string(s) + " output");
        }
        if (animation.channels.empty())
            file.note(where, "has no channel that can be played; dropped");
        else
            scene.animations.push_back(std::move(animation));
    }
}

}  // namespace daylit::gltf
