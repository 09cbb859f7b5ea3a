// Animation sampling (glTF 2.0, appendix C), the node tree, moves and skins.
#include "engine/scene/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace daylit {
namespace {

/// A node's own transform and weights while they may still change.
struct Local {
    Vec3 translation;
    Quat rotation;
    Vec3 scale;
};

/// Between which keys a time lies and how far from one to the next.
struct KeyPosition {
    std::size_t from = 0, to = 0;
    float share = 0.0f;
    float seconds = 0.0f;  // between the two
};

KeyPosition locate_key(const std::vector<float>& times, float time) {
    if (time <= times.front()) return {0, 0, 0.0f, 0.0f};
    if (time >= times.back()) return {times.size() - 1, times.size() - 1, 0.0f, 0.0f};
    const auto next = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    const float seconds = times[next] - times[next - 1];
    return {next - 1, next, (time - times[next - 1]) / seconds, seconds};
}

/// Component c of a key; part 0 to 2 is in-tangent, value, out-tangent of a cubic spline.
float key_value(const AnimationChannel& channel, std::size_t key, std::size_t components, std::size_t c,
                std::size_t part) {
    if (channel.interpolation != Interpolation::CubicSpline) return channel.values[key * components + c];
    return channel.values[(3 * key + part) * components + c];
}

float interpolate(const AnimationChannel& channel, const KeyPosition& at, std::size_t components, std::size_t c) {
    const float a = key_value(channel, at.from, components, c, 1);
    if (channel.interpolation == Interpolation::Step || at.from == at.to) return a;
    const float b = key_value(channel, at.to, components, c, 1), t = at.share;
    if (channel.interpolation == Interpolation::Linear) return a + (b - a) * t;
    const float leave = at.seconds * key_value(channel, at.from, components, c, 2);
    const float arrive = at.seconds * key_value(channel, at.to, components, c, 0);
    const float t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * leave + (3 * t2 - 2 * t3) * b + (t3 - t2) * arrive;
}

Quat sample_rotation(const AnimationChannel& channel, const KeyPosition& at) {
    const auto stored = [&](std::size_t key) {
        const auto c = [&](std::size_t i) { return key_value(channel, key, 4, i, 1); };
        return Quat(c(3), c(0), c(1), c(2));
    };
    if (channel.interpolation == Interpolation::Linear)
        return glm::normalize(glm::slerp(stored(at.from), stored(at.to), at.share));
    Quat q(interpolate(channel, at, 4, 3), interpolate(channel, at, 4, 0), interpolate(channel, at, 4, 1),
           interpolate(channel, at, 4, 2));
    const float length = glm::length(q);
    return length > 1e-6f ? q / length : Quat(1, 0, 0, 0);
}

void apply_channel(const AnimationChannel& channel, float time, Local& local, std::vector<float>& weights) {
    const KeyPosition at = locate_key(channel.times, time);
    const auto vector = [&] {
        return Vec3(interpolate(channel, at, 3, 0), interpolate(channel, at, 3, 1), interpolate(channel, at, 3, 2));
    };
    switch (channel.path) {
        case AnimationPath::Translation:
            local.translation = vector();
            break;
        case AnimationPath::Scale:
            local.scale = vector();
            break;
        case AnimationPath::Rotation:
            local.rotation = sample_rotation(channel, at);
            break;
        case AnimationPath::Weights:
            for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = interpolate(channel, at, weights.size(), i);
    }
}

Mat4 matrix_of(const Local& local) {
    Mat4 matrix = glm::mat4_cast(local.rotation);
    for (int c = 0; c < 3; ++c) matrix[c] *= local.scale[c];
    matrix[3] = Vec4(local.translation, 1.0f);
    return matrix;
}

std::vector<std::vector<float>> rest_weights(const Scene& scene) {
    std::vector<std::vector<float>> weights(scene.nodes.size());
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        if (node.mesh == -1) continue;
        weights[n] =
            node.morph_weights.empty() ? scene.meshes[std::size_t(node.mesh)].morph_weights : node.morph_weights;
    }
    return weights;
}

Mat4 moved(const Mat4& world_from_node, const NodeMove& move) {
    Mat4 matrix = glm::rotate(Mat4(1.0f), move.yaw, Vec3(0, 1, 0)) * world_from_node;
    matrix[3] = Vec4(move.position, 1.0f);
    return matrix;
}

}  // namespace

Pose pose_scene(const Scene& scene, double seconds, std::span<const NodeMove> moves) {
    Pose pose;
    pose.world_from_node.assign(scene.nodes.size(), Mat4(1.0f));
    pose.morph_weights = rest_weights(scene);
    std::vector<Local> locals;
    locals.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) locals.push_back({node.translation, node.rotation, node.scale});
    for (const Animation& animation : scene.animations) {
        const double time = animation.duration > 0 ? std::fmod(seconds, double(animation.duration)) : 0.0;
        for (const AnimationChannel& channel : animation.channels)
            apply_channel(channel, float(time < 0 ? time + double(animation.duration) : time),
                          locals[std::size_t(channel.node)], pose.morph_weights[std::size_t(channel.node)]);
    }
    for (const int n : scene.order) {
        const Node& node = scene.nodes[std::size_t(n)];
        const Mat4 parent_from_node = node.matrix ? *node.matrix : matrix_of(locals[std::size_t(n)]);
        Mat4& world = pose.world_from_node[std::size_t(n)];
        world =
            node.parent == -1 ? parent_from_node : pose.world_from_node[std::size_t(node.parent)] * parent_from_node;
        // In place, so that what hangs below a moved node goes along.
        for (const NodeMove& move : moves)
            if (move.node == n) world = moved(world, move);
    }
    return pose;
}

std::vector<Mat4> skin_matrices(const Scene& scene, const Pose& pose, int node) {
    const Skin& skin = scene.skins[std::size_t(scene.nodes[std::size_t(node)].skin)];
    std::vector<Mat4> matrices;
    matrices.reserve(skin.joints.size());
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
        matrices.push_back(pose.world_from_node[std::size_t(skin.joints[j])] * skin.joint_from_mesh[j]);
    return matrices;
}

}  // namespace daylit
