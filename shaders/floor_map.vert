// A square on the floor below a sphere, as large as the part of the floor that the sphere darkens.
#include "frame.glsl"
layout(location = 0) in vec4 sphere;  // centre, radius
layout(location = 1) in vec3 colour;
out vec2 offset;                  // m, from the point below the centre
flat out vec2 height_and_radius;  // of the sphere, m
flat out vec3 tint;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  height_and_radius = vec2(max(sphere.y - frame.floor_map.w, 0.8 * sphere.w), sphere.w);
  offset = corner * 4.0 * sphere.w;
  tint = colour;
  gl_Position = vec4(2.0 * floor_map_coordinates(sphere.xz + offset) - 1.0, 0.0, 1.0);
}
