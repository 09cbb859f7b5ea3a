// Look-up in an irradiance volume. C++ and GLSL run this very code; what differs is where the arrays come from.
#ifndef SHADERS_SHARED_VOLUME_H
#define SHADERS_SHARED_VOLUME_H
#include "shaders/shared/sh.h"
#include "shaders/shared/volume_tree.h"
#ifdef __cplusplus
namespace daylit::glsl {
/// The arrays of a volume at one hour.
struct VolumeArrays {
    VolumeGrid grid;
    const uint* nodes;
    const VolumeCell* cells;
    const VolumeCut* cuts;
    const vec4* records;  // kVolumeNumbers each
};
}  // namespace daylit::glsl
#define VOLUME_IN const VolumeArrays &arrays,
#define VOLUME_ARRAYS arrays,
#define VOLUME_GRID arrays.grid
#define VOLUME_NODE(i) arrays.nodes[i]
#define VOLUME_CELL(i) arrays.cells[i]
#define VOLUME_CUT(i) arrays.cuts[i]
#define VOLUME_RECORD(i) arrays.records[i]
#else
// A program defines VOLUME_GRID, VOLUME_NODE(i), VOLUME_CELL(i), VOLUME_CUT(i) and VOLUME_RECORD(i) before.
#define VOLUME_IN
#define VOLUME_ARRAYS
#endif
SHARED_BEGIN

struct VolumePlace {
    uint cell;
    vec3 t;  // inside the cell, [0,1]
};

// Any finite place; beside the volume, the nearest place inside.
SHARED_FN VolumePlace volume_place(VOLUME_IN vec3 place) {
    VolumeGrid grid = VOLUME_GRID;
    vec3 size = vec3(grid.size.x, grid.size.y, grid.size.z);
    vec3 inside = clamp((place - vec3(grid.frame.x, grid.frame.y, grid.frame.z)) * grid.frame.w, vec3(0.0f), size);
    vec3 root = min(floor(inside), size - vec3(1.0f));
    vec3 t = inside - root;
    uint node = VOLUME_NODE(uint((root.z * size.y + root.y) * size.x + root.x));
    for (int level = 0; level < kVolumeMostLevels && (node & kVolumeKind) == kVolumeInner; ++level) {
        vec3 half_t = 2.0f * t;
        vec3 upper = step(vec3(1.0f), half_t);
        t = half_t - upper;
        node = VOLUME_NODE(node + uint(upper.x + 2.0f * upper.y + 4.0f * upper.z));
    }
    if ((node & kVolumeKind) == kVolumeCut) {
        VolumeCut wall = VOLUME_CUT(node & ~kVolumeKind);
        bool front = wall.plane.x * place.x + wall.plane.y * place.y + wall.plane.z * place.z + wall.plane.w >= 0.0f;
        node = front ? wall.nodes.x : wall.nodes.y;
    }
    if ((node & kVolumeKind) == kVolumeNearest) {
        vec4 box = VOLUME_CELL(node & ~kVolumeKind).box;
        t = clamp((place - vec3(box.x, box.y, box.z)) / box.w, vec3(0.0f), vec3(1.0f));
    }
    VolumePlace found;
    found.cell = node & ~kVolumeKind;
    found.t = t;
    return found;
}

// How much a corner's value (x) and its change along x, y, z (yzw) count at t in a cell of this side: Adini's cubic
// element, Hermite along each axis and fourth order with values and gradients alone (Adini and Clough 1961).
SHARED_FN vec4 volume_corner_weights(int corner, vec3 t, float side) {
    vec3 at = vec3(float(corner & 1), float((corner >> 1) & 1), float(corner >> 2));
    vec3 u = abs(t - at), rest = vec3(1.0f) - u;
    float w = rest.x * rest.y * rest.z;
    vec3 bend = u * (vec3(1.0f) - 2.0f * u);
    vec3 slope = (w * side) * (t - at) * rest;
    return vec4(w * (1.0f + bend.x + bend.y + bend.z), slope.x, slope.y, slope.z);
}

struct VolumeSh {
    vec3 c[9];
};

// Radiance SH at a place of a cell.
SHARED_FN VolumeSh volume_sh(VOLUME_IN VolumePlace at) {
    VolumeCell cell = VOLUME_CELL(at.cell);
    vec4 sum[kVolumeNumbers];
    for (int i = 0; i < kVolumeNumbers; ++i) sum[i] = vec4(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        vec4 weights = volume_corner_weights(corner, at.t, cell.box.w);
        uint first = uint(kVolumeNumbers) * (corner < 4 ? cell.low[corner] : cell.high[corner - 4]);
        for (int i = 0; i < kVolumeNumbers; ++i) sum[i] += weights * VOLUME_RECORD(first + uint(i));
    }
    VolumeSh sh;
    for (int i = 0; i < kShCoefficients; ++i)
        for (int channel = 0; channel < 3; ++channel) {
            vec4 parts = sum[3 * i + channel];
            sh.c[i][channel] = (parts.x + parts.y) + (parts.z + parts.w);
        }
    return sh;
}

// Irradiance, held above a share of its mean over all normals: neither negative, nor black where there is light. Three
// bands of a single far light ring by 4 to 6 % of what it gives, which is four times the mean, and cubics between corners
// swing further: on dark sides less than this share is no knowledge.
const float kVolumeLeastOfMean = 0.05f;
SHARED_FN vec3 volume_held(vec3 irradiance, vec3 mean) {
    return max(irradiance, kVolumeLeastOfMean * max(mean, vec3(0.0f)));
}

// Irradiance on a plane with this unit normal, and (odd = -1) on its back.
SHARED_FN vec3 volume_irradiance(VolumeSh sh, vec3 normal, float odd) {
    Sh9 lobe = sh_irradiance_weights(normal);
    vec3 mean = lobe.c[0] * sh.c[0], sum = mean;
    for (int i = 1; i < 4; ++i) sum += (odd * lobe.c[i]) * sh.c[i];
    for (int i = 4; i < 9; ++i) sum += lobe.c[i] * sh.c[i];
    return volume_held(sum, mean);
}

// Mean radiance over a Phong lobe about this unit direction; never negative.
SHARED_FN vec3 volume_radiance(VolumeSh sh, vec3 direction, float exponent) {
    Sh9 lobe = sh_lobe_weights(direction, exponent);
    vec3 sum = lobe.c[0] * sh.c[0];
    for (int i = 1; i < 9; ++i) sum += lobe.c[i] * sh.c[i];
    return max(sum, vec3(0.0f));
}

SHARED_END
#endif
