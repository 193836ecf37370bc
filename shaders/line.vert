#version 330 core
// A line with room for round ends and a soft edge: a rectangle that faces the screen, or its axis alone, which the
// driver then makes wide.
#include "frame.glsl"
layout(location = 0) in vec3 a;
layout(location = 1) in vec3 b;
layout(location = 2) in vec4 colour;
uniform float width;
uniform float sides;  // 1 for a rectangle, 0 for its axis
flat out vec4 ends;   // a and b on the screen, pixels
flat out vec4 line_colour;

void main() {
  // A thousandth nearer to the eye, so that a line on a surface is not lost in it.
  vec4 from = frame.clip_from_world * vec4(mix(a, frame.eye.xyz, 0.001), 1.0);
  vec4 to = frame.clip_from_world * vec4(mix(b, frame.eye.xyz, 0.001), 1.0);
  line_colour = colour;
  // Cut at the near plane: behind the eye there are no pixels.
  float d0 = from.z + from.w, d1 = to.z + to.w;
  if (d0 < 0.0 && d1 < 0.0) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  vec4 start = from, end = to;
  if (d0 < 0.0) start = mix(from, to, (d0 - 1e-6 * d1) / (d0 - d1));
  if (d1 < 0.0) end = mix(to, from, (d1 - 1e-6 * d0) / (d1 - d0));

  vec2 half_size = 0.5 * frame.viewport.zw;
  vec2 p0 = start.xy / start.w * half_size, p1 = end.xy / end.w * half_size;
  ends = vec4(p0, p1) + vec4(half_size + frame.viewport.xy, half_size + frame.viewport.xy);
  float span = length(p1 - p0);
  vec2 direction = span > 1e-4 ? (p1 - p0) / span : vec2(1.0, 0.0);
  float reach = 0.5 * width + 0.5;  // beyond it line.frag covers nothing
  bool at_end = (gl_VertexID & 1) == 1;
  float side = (gl_VertexID & 2) == 2 ? reach : -reach;
  float along = at_end ? span + reach : -reach;
  vec2 pixel = p0 + direction * along + vec2(-direction.y, direction.x) * side * sides;
  vec4 clip = at_end ? end : start;
  gl_Position = vec4(pixel / half_size * clip.w, clip.zw);
}
