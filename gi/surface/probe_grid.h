#pragma once
// Where moving things can be, and the probes that stand there.
#include <array>
#include <vector>

#include "engine/scene/scene.h"

namespace daylit {

/// Probe (x, y, z) stands at origin + spacing * (x, y, z), x running fastest.
struct ProbeGrid {
    Vec3 origin = Vec3(0.0f);
    float spacing = 1.0f;  // metres
    std::array<int, 3> size = {0, 0, 0};
    std::vector<std::uint32_t> wanted;  // probes that something may come near, ascending; the others only fill the box
    std::size_t count() const { return std::size_t(size[0]) * std::size_t(size[1]) * std::size_t(size[2]); }
    Vec3 position(std::size_t probe) const;
};

/// The box around all places that dynamic nodes sweep in their animations, and a margin. Without a dynamic node the
/// box around the static ones, all of it wanted. Empty when there is neither.
/// spacing   metres, wider where the box would need more than most_probes
ProbeGrid make_probe_grid(const Scene& scene, float spacing, std::size_t most_probes);

}  // namespace daylit
