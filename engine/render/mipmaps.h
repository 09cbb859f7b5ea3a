#pragma once
// The mipmap chain of a texture, worked out on the CPU: a software driver takes several times as long for it, one level
// after the other, where textures can be done at once.
#include <vector>

#include "engine/base/image.h"

namespace daylit {

/// Levels 1, 2, ... down to one texel, each the mean over 2 x 2 of the one before (3 along a side of odd length).
/// srgb   RGB is coded; means are those of the light it stands for
std::vector<Image8> mipmaps(const Image8& image, bool srgb);

}  // namespace daylit
