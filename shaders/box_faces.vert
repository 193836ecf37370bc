// The faces of a box.
#include "frame.glsl"
#include "cube.glsl"
layout(location = 0) in vec3 lo;
layout(location = 1) in vec3 hi;
layout(location = 2) in vec4 colour;
flat out vec4 face_colour;

void main() {
  face_colour = colour;
  gl_Position = frame.clip_from_world * vec4(mix(lo, hi, 0.5 * cube_position() + 0.5), 1.0);
}
