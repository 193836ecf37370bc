#version 330 core
layout(location = 0) in vec3 direction;
layout(location = 1) in vec4 sphere;
uniform mat4 light_clip;

void main() { gl_Position = light_clip * vec4(sphere.xyz + sphere.w * direction, 1.0); }
