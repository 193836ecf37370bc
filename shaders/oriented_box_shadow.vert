#include "cube.glsl"
layout(location = 0) in vec3 centre;
layout(location = 1) in mat3 half_axes;
uniform mat4 light_clip_from_world;

void main() { gl_Position = light_clip_from_world * vec4(centre + half_axes * cube_position(), 1.0); }
