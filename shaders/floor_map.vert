#version 330 core
// A square on the floor round the foot of a sphere, as far out as it darkens the floor.
#include "frame.glsl"
layout(location = 0) in vec4 sphere;  // centre, radius
layout(location = 1) in vec3 colour;
out vec2 offset;
flat out vec2 shape;  // height and radius of the sphere
flat out vec3 tint;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  shape = vec2(max(sphere.y - frame.floor_map.w, 0.8 * sphere.w), sphere.w);
  offset = corner * 4.0 * sphere.w;
  tint = colour;
  gl_Position = vec4(2.0 * floor_map_coordinates(sphere.xz + offset) - 1.0, 0.0, 1.0);
}
