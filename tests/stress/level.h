#pragma once
// Small levels with hostile numbers, taken through the reader, and what must hold of any light in them.
#include <gtest/gtest.h>

#include <cmath>

#include "demo/lightmap_points.h"
#include "demo/sample_points.h"
#include "engine/scene/gltf.h"
#include "gi/bake.h"
#include "gi/transport/path_trace/path_trace.h"
#include "tests/support/gltf_builder.h"

namespace daylit::stress {

using test::Json;

/// Quads and lamps as a glTF file.
class Level {
  public:
    int material(const Rgb& albedo, const Rgb& emission = Rgb(0.0f), float metallic = 0.0f, float roughness = 1.0f) {
        Json m = {{"pbrMetallicRoughness",
                   {{"baseColorFactor", {albedo.r, albedo.g, albedo.b, 1.0f}},
                    {"metallicFactor", metallic},
                    {"roughnessFactor", roughness}}},
                  {"extensions", {{"KHR_materials_specular", {{"specularFactor", metallic > 0.0f ? 1.0f : 0.0f}}}}}};
        const float strongest = std::max({emission.r, emission.g, emission.b});
        if (strongest > 0.0f) {
            m["emissiveFactor"] = {emission.r / strongest, emission.g / strongest, emission.b / strongest};
            m["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strongest}};
        }
        builder_.json["materials"].push_back(m);
        return int(builder_.json["materials"].size()) - 1;
    }

    void triangles(const std::vector<Vec3>& corners, int material) {
        std::vector<float> values;
        for (const Vec3& c : corners) values.insert(values.end(), {c.x, c.y, c.z});
        primitives_.push_back(
            {{"attributes", {{"POSITION", builder_.floats("VEC3", values)}}}, {"material", material}});
    }
    /// Its normal is cross(u, v).
    void quad(const Vec3& origin, const Vec3& u, const Vec3& v, int material) {
        triangles({origin, origin + u, origin + u + v, origin, origin + u + v, origin + v}, material);
    }
    /// The inside of a box: floor and walls, and the ceiling of a closed one.
    void room(const Vec3& low, const Vec3& size, int material, bool closed) {
        const Vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
        quad(low, z, x, material);
        quad(low, y, z, material);
        quad(low + x, z, y, material);
        quad(low, x, y, material);
        quad(low + z, y, x, material);
        if (closed) quad(low + y, x, z, material);
    }
    void lamp(const Vec3& place, float candela) {
        Json& lights = builder_.json["extensions"]["KHR_lights_punctual"]["lights"];
        lights.push_back({{"type", "point"}, {"intensity", candela}});
        lamps_.push_back({{"translation", {place.x, place.y, place.z}},
                          {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}}});
    }

    Scene load(const LoadOptions& options = {}) {
        Json& json = builder_.json;
        json["extensionsUsed"] = {"KHR_materials_specular", "KHR_materials_emissive_strength", "KHR_lights_punctual"};
        json["meshes"] = {{{"primitives", primitives_}}};
        json["nodes"] = {{{"mesh", 0}}};
        for (const Json& lamp : lamps_) json["nodes"].push_back(lamp);
        std::vector<int> nodes(json["nodes"].size());
        for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = int(i);
        json["scenes"] = {{{"nodes", nodes}}};
        const test::TemporaryFolder folder;
        return load_scene(builder_.save_glb(folder / "stress.glb"), options);
    }

  private:
    test::GltfBuilder builder_;
    std::vector<Json> primitives_, lamps_;
};

/// A sky of the same radiance all around and no sun.
inline LightSettings constant_sky(float radiance) {
    LightSettings light;
    light.sun = SunSource::None, light.sky = SkySource::Constant, light.sky_radiance = Rgb(radiance);
    return light;
}
inline LightSettings no_light() {
    return constant_sky(0.0f);
}

/// Coarse, so that a test takes a second.
inline BakeSettings coarse(const LightSettings& light) {
    BakeSettings settings;
    settings.light = light, settings.error = 1.0, settings.parts = {"lightmap"};
    return settings;
}

struct Light {
    double mean = 0.0, most = 0.0;  // lux, over points and channels
};

/// Every value a number that is not negative.
inline Light sound(const std::vector<Rgb>& light, const std::string& what) {
    Light sums;
    for (const Rgb& e : light)
        for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(std::isfinite(e[c]) && e[c] >= 0.0f) << what << ": " << e[c];
            sums.mean += double(e[c]) / (3.0 * double(light.size()));
            sums.most = std::max(sums.most, double(e[c]));
        }
    return sums;
}

/// Indirect irradiance of a bake at an hour of the light that it was made for, lux.
inline std::vector<Rgb> lightmap_light(const Baked& baked, const Scene& scene, double hour,
                                       const std::vector<SurfaceSample>& points) {
    const LightModel light(baked.light, placed_lights(scene, pose_scene(scene)));
    return lightmap_irradiance(*baked.lightmap, scene, light.scales(hour, baked.light.clouds), hour, points);
}

/// Places on the scene's surfaces.
inline std::vector<SurfaceSample> places(const Scene& scene, int count) {
    const Pose pose = pose_scene(scene);
    const WorldMesh mesh = world_mesh(scene, pose, Part::All);
    return sample_surface(RayScene(scene, mesh), pose, count, 1);
}

inline Light baked_light(const Scene& scene, const BakeSettings& settings, double hour = 12.0, int points = 200) {
    const Baked baked = bake(scene, settings);
    EXPECT_TRUE(baked.lightmap.has_value());
    if (!baked.lightmap) return {};
    return sound(lightmap_light(baked, scene, hour, places(scene, points)), "bake");
}

inline Light traced_light(const Scene& scene, const LightSettings& light, int spp = 64, int bounces = 1000,
                          double hour = 12.0, int points = 100) {
    const Pose pose = pose_scene(scene);
    const WorldMesh mesh = world_mesh(scene, pose, Part::All);
    const RayScene rays(scene, mesh);
    const std::vector<PlacedLight> lamps = placed_lights(scene, pose);
    return sound(
        path_trace_irradiance(rays, LightModel(light, lamps).at(hour), lamps, places(scene, points),
                              {.spp = spp, .max_bounces = bounces, .layer = Layer::Indirect}),
        "path tracer");
}

}  // namespace daylit::stress
