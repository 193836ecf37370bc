#include "frame.glsl"
#include "surface.glsl"
in float mark;
uniform vec3 mark_colour;
out vec4 fragment;

// A surface whose regions with marks above one half are hatched and have a solid border. Between the stripes, the
// colour of the body stays visible.
void main() {
  float inside = (mark - 0.5) / max(fwidth(mark), 1e-6);  // pixels from the border
  float region = clamp(inside + 0.5, 0.0, 1.0);
  float border = 1.0 - clamp(inside - 1.25 * frame.eye.w, 0.0, 1.0);
  float stripe = abs(fract((gl_FragCoord.x + gl_FragCoord.y) / (7.0 * frame.eye.w)) - 0.5) * 7.0 * frame.eye.w;
  float hatching = mix(0.1, 0.65, clamp(frame.eye.w + 0.5 - stripe, 0.0, 1.0));
  fragment = vec4(mix(surface_colour(), mark_colour, region * max(0.85 * border, hatching)), 1.0);
}
