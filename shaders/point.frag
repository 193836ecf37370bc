#include "frame.glsl"
uniform float diameter;
uniform float opacity;
in vec2 offset;
flat in vec4 point_colour;
out vec4 fragment;

// A disc with a darker rim, so that it stands out on a body of the same colour.
void main() {
  float distance = length(offset);
  float coverage = clamp(0.5 * diameter + 0.5 - distance, 0.0, 1.0);
  if (coverage <= 0.0) discard;
  float rim = clamp(distance - 0.5 * diameter + 1.25 * frame.eye.w, 0.0, 1.0) * step(4.0, diameter / frame.eye.w);
  fragment = vec4(point_colour.rgb * (1.0 - 0.55 * rim), point_colour.a * opacity * coverage);
}
