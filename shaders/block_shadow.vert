#version 330 core
layout(location = 0) in vec3 place;
layout(location = 2) in vec3 centre;
layout(location = 3) in mat3 half_axes;
uniform mat4 light_clip;

void main() { gl_Position = light_clip * vec4(centre + half_axes * place, 1.0); }
