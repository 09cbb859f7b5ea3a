#pragma once
// glTF 2.0 in: .gltf and .glb, through tinygltf, then checked accessor by accessor with overflow-safe arithmetic.
#include <filesystem>

#include "engine/scene/scene.h"

namespace daylit {

/// Metres from the origin, along any axis, beyond which nothing may lie: float positions are 8 m apart there, and
/// squared areas leave a float's range.
inline constexpr float kMaxCoordinate = 1.0e8f;

struct LoadOptions {
    double unit = 0.0;     // metres per file unit; 0: extras.daylit.unit, else 1
    bool lambert = false;  // --materials lambert: base colour and emission only
};

/// Reads, validates and completes a scene.
/// throws Error that names the file and the place in it for anything unsafe: missing or short buffers, indices beyond
/// the vertices, cycles, NaN or infinite numbers, unreadable images, required extensions that are not supported.
/// Optional unknown extensions and dropped lines are listed in Scene::notes.
Scene load_scene(const std::filesystem::path& path, const LoadOptions& options = {});

}  // namespace daylit
