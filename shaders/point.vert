#include "frame.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
uniform float diameter;
out vec2 offset;  // pixels from the centre
flat out vec4 point_colour;

void main() {
  vec4 centre = frame.clip_from_world * vec4(mix(position, frame.eye.xyz, 0.002), 1.0);
  offset = (vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0) * (0.5 * diameter + 0.5);
  point_colour = colour;
  gl_Position = centre + vec4(offset * 2.0 / frame.viewport.zw * centre.w, 0.0, 0.0);
}
