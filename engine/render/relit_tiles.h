#pragma once
// Which tiles of a lightmap have to be worked out again: those in view that do not have the present light yet.
#include <cstdint>
#include <vector>

#include "engine/baked/day_lightmap.h"
#include "engine/render/culling.h"

namespace daylit {

/// World bounds of what each tile lights; a box that was never added to where a tile lights nothing.
/// still   world_mesh(scene, pose, Part::Static), to which map.corner_uvs belong
std::vector<Bounds> tile_bounds(const DayLightmap& map, const WorldMesh& still);

class RelitTiles {
  public:
    /// tiles   that hold light; bounds are not known yet, so all count as seen
    explicit RelitTiles(std::vector<std::uint32_t> tiles) : tiles_(std::move(tiles)), lit_(tiles_.size(), false) {}

    /// bounds   one a tile of the map
    void set_bounds(std::vector<Bounds> bounds) { bounds_ = std::move(bounds); }
    /// The light changed: no tile has it.
    void forget() { lit_.assign(tiles_.size(), false); }

    bool any_unlit(const Frustum& seen) const;
    /// The tiles in view that have to be worked out, in the order in which they were given; from now on they count as
    /// lit.
    std::vector<std::uint32_t> take_unlit(const Frustum& seen);

  private:
    bool unlit(std::size_t i, const Frustum& seen) const {
        return !lit_[i] && (bounds_.empty() || may_see(seen, bounds_[tiles_[i]]));
    }

    std::vector<std::uint32_t> tiles_;
    std::vector<bool> lit_;
    std::vector<Bounds> bounds_;
};

}  // namespace daylit
