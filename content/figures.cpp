#include "content/figures.h"

#include <array>
#include <cmath>

#include "content/sculpt.h"

namespace daylit::content {
namespace {

enum Joint {
    kHips,
    kSpine,
    kChest,
    kHead,
    kArmL,
    kForearmL,
    kHandL,
    kArmR,
    kForearmR,
    kHandR,
    kThighL,
    kShinL,
    kFootL,
    kThighR,
    kShinR,
    kFootR,
    kJoints
};

// Rest pose of a man of 1.76 m, facing +Z; joint heads in metres. His left is +X.
constexpr std::array<int, kJoints> kParent = {-1,    kHips,     kSpine, kChest,  kChest, kArmL, kForearmL, kChest,
                                              kArmR, kForearmR, kHips,  kThighL, kShinL, kHips, kThighR,   kShinR};
const std::array<Vec3, kJoints> kRest = {
    Vec3(0, 0.95f, 0),        {0, 1.08f, 0},           {0, 1.28f, 0},         {0, 1.52f, 0.01f},
    {0.19f, 1.43f, 0},        {0.235f, 1.14f, -0.01f}, {0.25f, 0.89f, 0.02f}, {-0.19f, 1.43f, 0},
    {-0.235f, 1.14f, -0.01f}, {-0.25f, 0.89f, 0.02f},  {0.095f, 0.92f, 0},    {0.1f, 0.5f, 0.01f},
    {0.1f, 0.09f, -0.02f},    {-0.095f, 0.92f, 0},     {-0.1f, 0.5f, 0.01f},  {-0.1f, 0.09f, -0.02f}};
const std::array<const char*, kJoints> kNames = {
    "hips",          "spine",      "chest",      "head",      "arm left",  "forearm left", "hand left",  "arm right",
    "forearm right", "hand right", "thigh left", "shin left", "foot left", "thigh right",  "shin right", "foot right"};

enum Cloth { kTunic, kSkin, kHair, kHose, kLeather, kHood };

Lump lump(const Vec3& a, const Vec3& b, float ra, float rb, int joint, int material, float blend = 0.03f,
          const Vec3& squash = Vec3(1.0f)) {
    return {.from = a,
            .to = b,
            .radius_from = ra,
            .radius_to = rb,
            .blend = blend,
            .joint = joint,
            .material = material,
            .squash = squash};
}

Sculpture townsman() {
    Sculpture s;
    auto& l = s.lumps;
    // Body and tunic: chest, belly, hips, and a skirt that goes with the thighs.
    l.push_back(lump({0, 1.3f, -0.005f}, {0, 1.4f, -0.005f}, 0.155f, 0.14f, kChest, kTunic, 0.0f, {1.22f, 1, 0.82f}));
    l.push_back(lump({0, 1.08f, 0.01f}, {0, 1.22f, 0}, 0.145f, 0.15f, kSpine, kTunic, 0.06f, {1.1f, 1, 0.85f}));
    l.push_back(lump({0, 0.94f, 0}, {0, 1.02f, 0}, 0.165f, 0.15f, kHips, kTunic, 0.06f, {1.08f, 1, 0.88f}));
    for (float side : {1.0f, -1.0f}) {
        const bool left = side > 0;
        const auto at = [side](float x, float y, float z) { return Vec3(side * x, y, z); };
        const int thigh = left ? kThighL : kThighR, shin = left ? kShinL : kShinR, foot = left ? kFootL : kFootR;
        const int arm = left ? kArmL : kArmR, forearm = left ? kForearmL : kForearmR, hand = left ? kHandL : kHandR;
        l.push_back(lump(at(0.07f, 0.88f, 0), at(0.105f, 0.6f, 0.005f), 0.125f, 0.135f, thigh, kTunic, 0.05f));
        l.push_back(lump(at(0.1f, 0.6f, 0.0f), at(0.1f, 0.47f, 0.01f), 0.078f, 0.062f, thigh, kHose, 0.02f));
        l.push_back(lump(at(0.1f, 0.48f, 0.005f), at(0.1f, 0.36f, -0.012f), 0.06f, 0.064f, shin, kHose, 0.03f));
        l.push_back(lump(at(0.1f, 0.36f, -0.012f), at(0.1f, 0.1f, -0.02f), 0.062f, 0.042f, shin, kHose, 0.03f));
        l.push_back(lump(at(0.1f, 0.24f, -0.015f), at(0.1f, 0.08f, -0.02f), 0.06f, 0.05f, foot, kLeather, 0.015f));
        l.push_back(lump(at(0.1f, 0.055f, -0.03f), at(0.108f, 0.04f, 0.14f), 0.052f, 0.038f, foot, kLeather, 0.03f));
        l.push_back(lump(at(0.165f, 1.42f, 0), at(0.2f, 1.4f, 0), 0.075f, 0.07f, arm, kTunic, 0.04f));
        l.push_back(lump(at(0.2f, 1.4f, 0), at(0.235f, 1.14f, -0.01f), 0.064f, 0.052f, arm, kTunic, 0.03f));
        l.push_back(lump(at(0.235f, 1.14f, -0.01f), at(0.248f, 0.93f, 0.015f), 0.052f, 0.05f, forearm, kTunic, 0.03f));
        l.push_back(lump(at(0.249f, 0.9f, 0.02f), at(0.248f, 0.81f, 0.035f), 0.034f, 0.03f, hand, kSkin, 0.012f,
                         {0.75f, 1, 1.2f}));
        l.push_back(lump(at(0.235f, 0.88f, 0.04f), at(0.225f, 0.83f, 0.06f), 0.014f, 0.011f, hand, kSkin, 0.012f));
    }
    // Belt, neck, head, nose, hair, and a hood lying on the shoulders.
    l.push_back(
        lump({0, 1.035f, 0.005f}, {0, 1.06f, 0.005f}, 0.16f, 0.16f, kSpine, kLeather, 0.01f, {1.09f, 1, 0.88f}));
    l.push_back(lump({0, 1.46f, 0}, {0, 1.55f, 0.012f}, 0.062f, 0.055f, kHead, kSkin, 0.03f));
    l.push_back(lump({0, 1.655f, 0.01f}, {0, 1.665f, 0.012f}, 0.1f, 0.098f, kHead, kSkin, 0.03f, {0.86f, 1.12f, 1.0f}));
    l.push_back(lump({0, 1.585f, 0.055f}, {0, 1.6f, 0.05f}, 0.042f, 0.05f, kHead, kSkin, 0.03f));
    l.push_back(lump({0, 1.665f, 0.105f}, {0, 1.63f, 0.122f}, 0.01f, 0.015f, kHead, kSkin, 0.012f));
    l.push_back(lump({0, 1.69f, -0.015f}, {0, 1.62f, -0.045f}, 0.105f, 0.085f, kHead, kHair, 0.015f, {0.9f, 1, 1}));
    l.push_back(lump({0, 1.46f, -0.02f}, {0, 1.49f, -0.01f}, 0.125f, 0.095f, kChest, kHood, 0.03f, {1.35f, 1, 1}));
    l.push_back(lump({0, 1.5f, -0.1f}, {0, 1.34f, -0.155f}, 0.07f, 0.02f, kChest, kHood, 0.04f));
    return s;
}

Vec4 quaternion(const Vec3& axis, float angle) {
    const Quat q = glm::angleAxis(angle, axis);
    return {q.x, q.y, q.z, q.w};
}

// One cycle is two steps; phase 0 is the left foot's heel strike. Angles in radians about +X: positive swings a limb
// back (towards -Z). The curves follow the shape of measured gait (Perry 1992): knee flexes in swing and a little in
// stance.
void add_walk_cycle(Level& level, const std::vector<int>& joints, float period) {
    LevelAnimation walk{"walk", {}};
    const int keys = 24;
    const auto channel = [&](int joint, AnimationPath path, const std::function<Vec4(double)>& value) {
        LevelChannel c{joints[std::size_t(joint)], path, {}, {}};
        for (int i = 0; i <= keys; ++i) {
            c.times.push_back(period * float(i) / keys);
            c.values.push_back(value(2.0 * kPi * (i % keys) / keys));
        }
        walk.channels.push_back(c);
    };
    const auto turn = [&](int joint, const Vec3& axis, const std::function<double(double)>& angle) {
        channel(joint, AnimationPath::Rotation, [=](double p) { return quaternion(axis, float(angle(p))); });
    };
    const Vec3 x(1, 0, 0), y(0, 1, 0);
    for (int side : {0, 1}) {
        const double shift = side ? kPi : 0.0;
        turn(side ? kThighR : kThighL, x, [=](double p) { return -0.42 * std::cos(p + shift) - 0.04; });
        turn(side ? kShinR : kShinL, x, [=](double p) {
            const double q = p + shift;
            const double swing = std::exp(3.2 * (std::cos(q - 4.6) - 1.0)),
                         stance = std::exp(5.0 * (std::cos(q - 0.75) - 1.0));
            return 0.06 + 0.95 * swing + 0.2 * stance;
        });
        turn(side ? kFootR : kFootL, x, [=](double p) {
            const double q = p + shift;
            return 0.35 * std::exp(6.0 * (std::cos(q - 3.7) - 1.0)) - 0.2 * std::exp(4.0 * (std::cos(q - 0.1) - 1.0));
        });
        turn(side ? kArmR : kArmL, x, [=](double p) { return 0.36 * std::cos(p + shift) + 0.05; });
        turn(side ? kForearmR : kForearmL, x, [=](double p) { return -0.28 + 0.14 * std::cos(p + shift); });
    }
    turn(kChest, y, [](double p) { return 0.09 * std::cos(p); });
    turn(kSpine, x, [](double) { return 0.04; });
    const Vec3 rest = kRest[kHips];
    channel(kHips, AnimationPath::Translation, [=](double p) {
        return Vec4(0.015f * float(std::sin(p)), rest.y - 0.025f - 0.02f * float(std::cos(2.0 * p)), 0, 0);
    });
    level.animations.push_back(walk);
}

// A stadium-shaped way: west over the courtyard, in by the arcade's first bay, along it, out by its last.
void add_way(Level& level, int node, float speed) {
    const float half = 9.35f, radius = 2.7f, middle_z = -9.7f, start_x = 3.0f;
    const float straight = 2.0f * half, bend = float(kPi) * radius, quarter = float(kPi) / 2;
    LevelAnimation way{"way", {{node, AnimationPath::Translation, {}, {}}, {node, AnimationPath::Rotation, {}, {}}}};
    const auto key = [&](float s, const Vec3& p, float yaw) {
        for (LevelChannel& c : way.channels) c.times.push_back(s / speed);
        way.channels[0].values.emplace_back(p, 0);
        way.channels[1].values.push_back(quaternion({0, 1, 0}, yaw));
    };
    const int steps = 16;
    // Turning right all the way; quaternions at the seam differ by sign alone, which turns nothing.
    const float west = start_x + half;
    key(0, {start_x, 0, middle_z + radius}, -quarter);
    for (int i = 0; i <= steps; ++i) {
        const float t = float(i) / steps, a = float(kPi) * t;
        key(west + bend * t, {-half - radius * std::sin(a), 0, middle_z + radius * std::cos(a)}, -quarter - a);
    }
    for (int i = 0; i <= steps; ++i) {
        const float t = float(i) / steps, a = float(kPi) * t;
        key(west + straight + bend * (1.0f + t), {half + radius * std::sin(a), 0, middle_z - radius * std::cos(a)},
            -3.0f * quarter - a);
    }
    key(2.0f * (straight + bend), {start_x, 0, middle_z + radius}, -5.0f * quarter);
    level.animations.push_back(way);
}

}  // namespace

LevelMesh brass_knight(int material) {
    Sculpture s;
    auto& l = s.lumps;
    const auto add = [&](const Vec3& a, const Vec3& b, float ra, float rb, float blend = 0.02f,
                         const Vec3& squash = Vec3(1.0f)) {
        l.push_back({.from = a,
                     .to = b,
                     .radius_from = ra,
                     .radius_to = rb,
                     .blend = blend,
                     .joint = 0,
                     .material = 0,
                     .squash = squash});
    };
    // Legs astride, one knee eased; surcoat, breast, arms on the pommel of a sword set point down before him.
    add({0.0f, 0.64f, 0}, {0, 0.72f, 0}, 0.115f, 0.1f, 0.0f, {1.1f, 1, 0.85f});
    add({0, 0.8f, -0.005f}, {0, 0.96f, -0.005f}, 0.098f, 0.115f, 0.05f, {1.2f, 1, 0.86f});
    add({0, 1.0f, 0}, {0, 1.03f, 0}, 0.07f, 0.06f, 0.05f, {1.5f, 1, 1});
    for (float side : {1.0f, -1.0f}) {
        const auto at = [side](float x, float y, float z) { return Vec3(side * x, y, z); };
        const float ease = side > 0 ? 0.045f : 0.0f;
        add(at(0.06f, 0.62f, 0), at(0.085f, 0.42f, 0.01f + ease), 0.098f, 0.085f, 0.04f);  // skirt of the surcoat
        add(at(0.082f, 0.42f, 0.01f + ease), at(0.085f, 0.34f, 0.01f + ease), 0.056f, 0.05f, 0.012f);
        add(at(0.085f, 0.345f, 0.03f + ease), at(0.085f, 0.345f, 0.03f + ease), 0.046f, 0.046f, 0.012f);  // knee cop
        add(at(0.088f, 0.33f, 0.005f + ease), at(0.1f, 0.1f, -0.015f + ease), 0.05f, 0.034f, 0.02f);
        add(at(0.1f, 0.06f, -0.02f + ease), at(0.115f, 0.045f, 0.1f + ease), 0.04f, 0.026f, 0.02f);
        add(at(0.155f, 1.02f, 0), at(0.165f, 1.0f, 0), 0.066f, 0.06f, 0.02f);  // pauldron
        add(at(0.165f, 0.99f, 0), at(0.2f, 0.83f, 0.02f), 0.048f, 0.042f, 0.015f);
        add(at(0.2f, 0.825f, 0.015f), at(0.2f, 0.825f, 0.015f), 0.05f, 0.05f, 0.01f);  // elbow
        add(at(0.198f, 0.82f, 0.025f), at(0.04f, 0.735f, 0.165f), 0.04f, 0.032f, 0.015f);
        add(at(0.03f, 0.735f, 0.17f), at(0.0f, 0.72f, 0.175f), 0.034f, 0.03f, 0.015f);
    }
    add({0, 0.705f, 0.0f}, {0, 0.735f, 0.0f}, 0.112f, 0.112f, 0.006f, {1.12f, 1, 0.88f});  // belt
    // Helm: bascinet with a pointed visor and a crest.
    add({0, 1.07f, 0.005f}, {0, 1.1f, 0.01f}, 0.06f, 0.058f, 0.02f);
    add({0, 1.155f, 0.005f}, {0, 1.2f, 0.0f}, 0.082f, 0.06f, 0.015f, {0.92f, 1.05f, 1});
    add({0, 1.14f, 0.055f}, {0, 1.13f, 0.115f}, 0.055f, 0.012f, 0.012f, {0.9f, 1, 1});
    add({0, 1.25f, -0.01f}, {0, 1.3f, -0.03f}, 0.02f, 0.008f, 0.02f);
    // Sword: blade, cross, grip, pommel.
    add({0, 0.03f, 0.19f}, {0, 0.6f, 0.185f}, 0.012f, 0.024f, 0.0f, {1, 1, 0.55f});
    add({-0.115f, 0.635f, 0.185f}, {0.115f, 0.635f, 0.185f}, 0.014f, 0.014f, 0.008f);
    add({0, 0.64f, 0.185f}, {0, 0.77f, 0.182f}, 0.014f, 0.013f, 0.008f);
    add({0, 0.785f, 0.182f}, {0, 0.785f, 0.182f}, 0.026f, 0.026f, 0.006f);
    // Cloak down the back, and the turf he stands on.
    add({0, 0.98f, -0.08f}, {0, 0.3f, -0.13f}, 0.09f, 0.125f, 0.03f, {1.5f, 1, 0.5f});
    add({0, 0.3f, -0.13f}, {0, 0.1f, -0.15f}, 0.125f, 0.14f, 0.03f, {1.5f, 1, 0.5f});
    add({0, 0.015f, 0.03f}, {0, 0.015f, 0.03f}, 0.24f, 0.24f, 0.015f, {1, 0.16f, 1});
    return polygonise(s, 0.0215f, {material}, false, "brass figure");
}

void add_walker(Castle& c) {
    Level& level = c.level;
    LevelNode walker;
    walker.name = "walking figure";
    walker.translation = {3.0f, 0, -7.0f};
    walker.rotation = glm::angleAxis(-float(kPi) / 2, Vec3(0, 1, 0));
    const int way = level.add_node(walker);
    LevelSkin skin{"walker", {}, {}};
    for (std::size_t j = 0; j < kJoints; ++j) {
        LevelNode joint;
        joint.name = kNames[j];
        const int parent = kParent[j];
        joint.translation = kRest[j] - (parent < 0 ? Vec3(0.0f) : kRest[std::size_t(parent)]);
        skin.joints.push_back(level.add_node(joint, parent < 0 ? way : skin.joints[std::size_t(parent)]));
        skin.joint_from_mesh.push_back(placed(-kRest[j]));
    }
    level.skins.push_back(skin);
    const Palette& use = c.use;
    LevelNode body;
    body.name = "figure body";
    body.mesh = level.add_mesh(polygonise(townsman(), 0.025f,
                                          {use.blue_wool, use.skin, use.hair, use.wool, use.leather, use.red_wool},
                                          true, "townsman"));
    body.skin = int(level.skins.size()) - 1;
    level.add_node(body, way);
    const float period = 1.08f, stride = 1.3f;  // two steps
    add_walk_cycle(level, skin.joints, period);
    add_way(level, way, stride / period);
}

}  // namespace daylit::content
