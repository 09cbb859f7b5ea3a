// What an irradiance volume is made of: an octree of cubic cells, at whose corners radiance SH and its change are kept.
#ifndef SHADERS_SHARED_VOLUME_TREE_H
#define SHADERS_SHARED_VOLUME_TREE_H
#include "shaders/shared/glsl.h"
SHARED_BEGIN

const int kVolumeMostLevels = 20;      // below the roots
const int kVolumeNumbers = 27;         // coefficient * 3 + channel; each a vec4: value, and change per metre along x, y, z
const uint kVolumeKind = 3u << 30;     // of a node: what the other 30 bits are
const uint kVolumeInner = 0u;          // the first of eight children, x fastest
const uint kVolumeCell = 1u << 30;     // a cell
const uint kVolumeCut = 2u << 30;      // a cut: a thin wall, and a cell on either side of it
const uint kVolumeNearest = 3u << 30;  // nothing of its own: the nearest cell, for what strays

struct VolumeGrid {
    vec4 frame;  // xyz: the first corner, metres; w: 1 / side of a root
    vec4 size;   // roots along x, y, z
};
struct VolumeCell {
    vec4 box;    // xyz: the first corner, metres; w: side
    uvec4 low;   // records of the corners, x fastest: the four of smaller z
    uvec4 high;  // and the four of larger z
};
struct VolumeCut {
    vec4 plane;   // in front where dot(xyz, place) + w >= 0
    uvec4 nodes;  // in front, behind
};

SHARED_END
#endif
