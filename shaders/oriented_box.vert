#version 330 core
#include "frame.glsl"
#include "ambient.glsl"

layout(location = 0) in vec3 cube_position;  // on the cube from -1 to 1
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 centre;
layout(location = 3) in mat3 half_axes;
layout(location = 6) in vec3 colour;
out vec3 world_position;
out vec3 world_normal;
out vec3 bounce;
out float sky_visibility;
flat out vec3 albedo;

void main() {
  world_position = centre + half_axes * cube_position;
  world_normal = normalize(half_axes * normal);
  sky_visibility = 1.0;
  bounce = floor_bounce(world_position, 0.5);
  albedo = colour;
  gl_Position = frame.clip_from_world * vec4(world_position, 1.0);
}
