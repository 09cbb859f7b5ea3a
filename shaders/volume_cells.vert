#version 450 core
// Cells of an irradiance volume as the lines of their edges, in the mean light of the corners that they join.
#include "shaders/frame.glsl"
#include "shaders/baked_volume.glsl"

layout(location = 0) out vec3 v_light;

// Which corner a vertex of a cell's twelve lines is: four along each axis.
int corner_of(int vertex) {
    int line = vertex / 2, axis = line / 4;
    return (vertex & 1) << axis | (line & 1) << (axis + 1) % 3 | (line >> 1 & 1) << (axis + 2) % 3;
}

void main() {
    VolumeCell cell = volume_cells[gl_InstanceID];
    int corner = corner_of(gl_VertexID);
    vec3 at = vec3(corner & 1, corner >> 1 & 1, corner >> 2);
    uint first = uint(kVolumeNumbers) * (corner < 4 ? cell.low[corner] : cell.high[corner - 4]);
    // Over all sides of a plane the mean is pi times the radiance's own mean.
    float weight = sh_irradiance_weights(vec3(1.0, 0.0, 0.0)).c[0] * LIGHT_SHOWN;
    for (int channel = 0; channel < 3; ++channel)
        v_light[channel] = max(weight * volume_records[first + uint(channel)].x, 0.0);
    gl_Position = frame.clip_from_world * vec4(cell.box.xyz + cell.box.w * at, 1.0);
}
