#include "engine/render/relit_tiles.h"

#include <algorithm>
#include <cmath>

namespace daylit {
namespace {

struct TileRange {
    int first, last;
};
/// Tiles along one axis in which bilinear fetches between two coordinates read.
TileRange tiles_between(float low, float high, int texels) {
    const auto tile = [&](float texel) {
        return std::clamp(int(std::floor(texel)), 0, texels - 1) / DayLightmap::kTileSide;
    };
    return {tile(low * float(texels) - 1.0f), tile(high * float(texels) + 1.0f)};
}

}  // namespace

std::vector<Bounds> tile_bounds(const DayLightmap& map, const WorldMesh& still) {
    std::vector<Bounds> bounds(map.tiles());
    for (std::size_t corner = 0; corner + 2 < map.corner_uvs.size(); corner += 3) {
        const Vec2 &a = map.corner_uvs[corner], &b = map.corner_uvs[corner + 1], &c = map.corner_uvs[corner + 2];
        const Vec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        const TileRange across = tiles_between(low.x, high.x, map.width),
                        down = tiles_between(low.y, high.y, map.height);
        for (int y = down.first; y <= down.last; ++y)
            for (int x = across.first; x <= across.last; ++x)
                for (std::size_t k = 0; k < 3; ++k)
                    bounds[std::size_t(y * map.tiles_across() + x)].add(still.positions[still.indices[corner + k]]);
    }
    return bounds;
}

bool RelitTiles::any_unlit(const Frustum& seen) const {
    for (std::size_t i = 0; i < tiles_.size(); ++i)
        if (unlit(i, seen)) return true;
    return false;
}

std::vector<std::uint32_t> RelitTiles::take_unlit(const Frustum& seen) {
    std::vector<std::uint32_t> taken;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
        if (!unlit(i, seen)) continue;
        lit_[i] = true;
        taken.push_back(tiles_[i]);
    }
    return taken;
}

}  // namespace daylit
