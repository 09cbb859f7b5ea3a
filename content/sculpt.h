#pragma once
// Sculpting with round cones: a figure is a smooth union of bones with thickness, turned into triangles by surface nets
// (Gibson 1998), vertices then pulled onto the surface.
#include <vector>

#include "content/level.h"

namespace daylit::content {

/// A round cone (Quilez, "distance functions"): a sphere at each end, joined by their tangent cone, then scaled about
/// `from` by `squash` along x, y, z for flat shapes. Blended with what came before over `blend` metres.
struct Lump {
    Vec3 from, to;
    float radius_from, radius_to;
    float blend = 0.03f;
    int joint = 0;     // that moves it, for skinning
    int material = 0;  // index into the materials passed to `polygonise`
    Vec3 squash = Vec3(1.0f);
};

struct Sculpture {
    std::vector<Lump> lumps;
    /// Signed distance (approximate where squashed), negative inside.
    float distance(const Vec3& p) const;
};

/// Closed mesh of the surface with cells of this size, split by material of the nearest lump. With `skinned`, joints
/// and weights by closeness to the lumps of each joint. Texture coordinates: x + z, and down y.
LevelMesh polygonise(const Sculpture& sculpture, float cell, const std::vector<int>& materials, bool skinned,
                     const std::string& name);

}  // namespace daylit::content
