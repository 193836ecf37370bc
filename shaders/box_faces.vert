#version 330 core
// The faces of a box: 36 vertices, told apart by gl_VertexID.
#include "frame.glsl"
layout(location = 0) in vec3 lo;
layout(location = 1) in vec3 hi;
layout(location = 2) in vec4 colour;
flat out vec4 face_colour;

void main() {
  int face = gl_VertexID / 6, corner = gl_VertexID % 6;
  int axis = face >> 1;
  ivec2 uv = ivec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5);
  if ((face & 1) == 0) uv = uv.yx;  // counter-clockwise from outside
  vec3 at;
  at[axis] = float(face & 1);
  at[(axis + 1) % 3] = float(uv.x);
  at[(axis + 2) % 3] = float(uv.y);
  face_colour = colour;
  gl_Position = frame.clip_from_world * vec4(mix(lo, hi, at), 1.0);
}
