#pragma once
// Levels with things that move, and looking up the volume that is baked for them.
#include <vector>

#include "gi/bake.h"
#include "scenes.h"

namespace daylit {

/// The quads of a TestScene as one node, and a small plate that moves at each of these places.
inline Scene with_plates(const TestScene& standing_part, const std::vector<Vec3>& plates) {
    TestScene made;
    made.scene = standing_part.scene, made.mesh = standing_part.mesh;
    const std::size_t standing = made.mesh.triangle_count();
    const std::uint32_t gray = made.add(lambert(Rgb(0.5f)));
    for (const Vec3& plate : plates) made.quad(gray, plate, Vec3(0.1f, 0, 0), Vec3(0, 0.1f, 0));
    Scene scene = made.scene;
    for (int node = 0; node <= int(plates.size()); ++node) {
        Mesh mesh;
        const std::size_t first = node ? standing + 2 * std::size_t(node - 1) : 0;
        const std::size_t last = node ? first + 2 : standing;
        for (std::size_t t = first; t < last; ++t) {
            Primitive p;
            p.material = int(made.mesh.materials[t]);
            p.indices = {0, 1, 2};
            for (std::size_t k = 3 * t; k < 3 * t + 3; ++k) {
                p.positions.push_back(made.mesh.positions[made.mesh.indices[k]]);
                p.normals.push_back(made.mesh.normals[made.mesh.indices[k]]);
            }
            mesh.primitives.push_back(p);
        }
        scene.meshes.push_back(mesh);
        scene.order.push_back(int(scene.nodes.size()));
        scene.nodes.emplace_back();
        scene.nodes.back().mesh = node;
        scene.nodes.back().dynamic = node > 0;
    }
    return scene;
}
inline Scene with_plate(const TestScene& standing_part, const Vec3& plate) {
    return with_plates(standing_part, {plate});
}

/// Walls of a closed box whose fronts look inwards.
inline TestScene room(const Material& floor, const Material& walls, const Material& side, const Vec3& size) {
    TestScene made;
    const std::uint32_t f = made.add(floor), w = made.add(walls), s = made.add(side);
    const Vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z), o(0.0f);
    made.quad(f, o, z, x);      // up
    made.quad(w, o + y, x, z);  // down
    made.quad(s, o, y, z);      // +x
    made.quad(w, o + x, z, y);  // -x
    made.quad(w, o, x, y);      // +z
    made.quad(w, o + z, y, x);  // -z
    return made;
}

/// At noon alone, with no light but what shines in the scene itself.
inline BakeSettings one_hour() {
    BakeSettings settings;
    settings.light.sun = SunSource::None;
    settings.light.sky = SkySource::None;
    settings.error = 0.1;
    settings.from_hour = settings.to_hour = 12.0;
    return settings;
}

inline const std::vector<Vec3> kNormals = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1),
                                           glm::normalize(Vec3(-1, -2, 1))};

/// Irradiance that the volume gives at noon.
inline Rgb at(const Baked& baked, const Vec3& place, const Vec3& normal) {
    const std::vector<Rgb> weights = baked.volume->basis.weights(LightModel(baked.light, {}).scales(12.0, 0.0), 12.0);
    return VolumeLight(*baked.volume, weights).irradiance(place, normal);
}

}  // namespace daylit
