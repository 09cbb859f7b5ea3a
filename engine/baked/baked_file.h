#pragma once
// scene.daylit: what the baker hands over to the runtime. The layout is described in FORMAT.md beside this file.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/baked/day_lightmap.h"
#include "engine/baked/irradiance_volume.h"
#include "engine/scene/sky.h"

namespace daylit {

/// Why a part of the bake is there or not; printed by `daylit info` and `daylit check`.
struct PlanItem {
    std::string part;  // lightmap, volume, dirmap, antiradiance, caustics
    bool done = false;
    std::string why;
    std::uint64_t bytes = 0;  // in the file
    double error = -1.0;      // relative error estimate, < 0: none
};

struct Baked {
    LightSettings light;  // what it was baked for
    double unit = 1.0;    // metres per file unit used on load
    bool lambert = false;
    std::uint64_t geometry_hash = 0;  // hash of the static WorldMesh; a mismatch means another scene
    std::optional<DayLightmap> lightmap;
    std::optional<IrradianceVolume> volume;
    std::vector<PlanItem> plan;
};

/// xxHash64 over positions, normals and indices of the static mesh.
std::uint64_t geometry_hash(const WorldMesh& static_mesh);

/// Which parts of a file are loaded; the others stay on the disk, unread and unchecked.
struct BakedParts {
    bool lightmap = true, volume = true;
};

/// throws Error for damaged, truncated, foreign or newer files; every section that is read is checksummed and sizes are
/// checked before memory is taken.
Baked read_baked(const std::filesystem::path& path, const BakedParts& wanted = {});
void write_baked(const std::filesystem::path& path, const Baked& baked);

/// throws Error naming both files when `baked` was made for other geometry.
void require_same_geometry(const Baked& baked, const std::filesystem::path& baked_path, const WorldMesh& static_mesh,
                           const std::filesystem::path& scene_path);

}  // namespace daylit
