// Baked indirect light in free space for any program: include this and call BakedVolume::bind().
#include "shaders/shared/volume_tree.h"

layout(std140, binding = 3) uniform VolumeUniforms { VolumeGrid volume_grid; };
layout(std430, binding = 4) readonly buffer VolumeNodes { uint volume_nodes[]; };
layout(std430, binding = 5) readonly buffer VolumeCells { VolumeCell volume_cells[]; };
layout(std430, binding = 6) readonly buffer VolumeCuts { VolumeCut volume_cuts[]; };
layout(std430, binding = 7) readonly buffer VolumeRecords { vec4 volume_records[]; };  // this hour's
#define VOLUME_GRID volume_grid
#define VOLUME_NODE(i) volume_nodes[i]
#define VOLUME_CELL(i) volume_cells[i]
#define VOLUME_CUT(i) volume_cuts[i]
#define VOLUME_RECORD(i) volume_records[i]
#include "shaders/shared/volume.h"

// Indirect irradiance in lux at a place, on a plane with this unit normal.
vec3 volume_irradiance_at(vec3 place, vec3 normal) {
    return volume_irradiance(volume_sh(volume_place(place)), normal, 1.0);
}
