#version 450 core
layout(location = 0) in vec3 v_light;
layout(location = 0) out vec4 out_light;

void main() {
    out_light = vec4(v_light, 1.0);
}
