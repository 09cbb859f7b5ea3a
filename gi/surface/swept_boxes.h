#pragma once
// Where moving things can be.
#include <vector>

#include "engine/scene/pose.h"

namespace daylit {

/// The box of each dynamic node at each of several moments of the longest animation, with a margin for moves by hand.
std::vector<Bounds> swept_boxes(const Scene& scene);

}  // namespace daylit
