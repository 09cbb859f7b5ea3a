#pragma once
// Where on a moving thing the light of an irradiance volume is looked up.
#include <string>

#include "engine/baked/irradiance_volume.h"

namespace daylit {

enum class VolumeMode {
    Auto,    // whichever of these the thing needs
    Object,  // once, in its middle
    Vertex,  // at every vertex, and blended between them
    Pixel    // at every pixel, with the normal that normal maps give there
};

/// throws UsageError that lists the names: auto, object, vertex, pixel.
VolumeMode parse_volume_mode(const std::string& name);
const char* name(VolumeMode mode);

/// How large a moving thing is, metres.
struct ThingSize {
    Bounds box;
    float edge = 0.0f;  // of its triangles, root mean square: how far apart it is asked at its vertices
};

/// The one rule. Cells are small where light changes much from place to place, so lengths are judged by the smallest
/// cell under the box' middle and corners: a thing of at most a quarter of it has one light; one of which the edges are
/// that short is asked at its vertices; any other at its pixels.
VolumeMode volume_mode_of(const ThingSize& thing, const VolumeTree& tree);

}  // namespace daylit
