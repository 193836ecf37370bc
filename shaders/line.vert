// A line, longer and wider than asked for, so that line.frag can draw round ends and a soft edge. It is either a
// rectangle that faces the screen or only the rectangle's axis, which the driver widens (glLineWidth).
#include "frame.glsl"
layout(location = 0) in vec3 a;
layout(location = 1) in vec3 b;
layout(location = 2) in vec4 colour;
uniform float width;
uniform float side_scale;  // 1: a rectangle; 0: its axis
flat out vec4 ends;        // a and b on the screen, pixels
flat out vec4 line_colour;

void main() {
  // A thousandth of the distance nearer to the eye, so that a line on a surface is not hidden by it.
  vec4 from = frame.clip_from_world * vec4(mix(a, frame.eye.xyz, 0.001), 1.0);
  vec4 to = frame.clip_from_world * vec4(mix(b, frame.eye.xyz, 0.001), 1.0);
  line_colour = colour;
  // Clipped at the near plane: a point behind the eye has no pixel.
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
  float margin = 0.5 * width + 0.5;  // line.frag draws nothing beyond it
  bool at_end = (gl_VertexID & 1) == 1;
  float side = (gl_VertexID & 2) == 2 ? margin : -margin;
  float along = at_end ? span + margin : -margin;
  vec2 pixel = p0 + direction * along + vec2(-direction.y, direction.x) * side * side_scale;
  vec4 clip = at_end ? end : start;
  gl_Position = vec4(pixel / half_size * clip.w, clip.zw);
}
