#pragma once
// Where charts lie in the atlas. Charts that are near each other in the world share tiles of it, since a tile's light
// is kept in few patterns (engine/baked/day_lightmap.h): what one sunbeam lights needs fewer than several rooms do.
#include <vector>

#include "engine/base/units.h"

namespace daylit {

/// What is packed: a kept layout or a chart.
struct Block {
    int width = 2, height = 2;  // texels
    Vec3 place = Vec3(0.0f);    // in the world; of a wall's two sides on different sides of it
    int x = 0, y = 0;           // out: where it lies
};

struct PackedSize {
    int width = 1, height = 1;
};

/// A block alone fills the atlas.
/// throws Error when the blocks do not fit into 16384 x 16384 texels.
PackedSize pack(std::vector<Block>& blocks);
[[noreturn]] void refuse_atlas_size();
inline constexpr int kMaxAtlasSide = 16384;

}  // namespace daylit
