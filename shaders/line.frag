uniform float width;
uniform float opacity;
flat in vec4 ends;  // of the line on the screen, pixels
flat in vec4 line_colour;
out vec4 fragment;

void main() {
  vec2 line = ends.zw - ends.xy, here = gl_FragCoord.xy - ends.xy;
  float nearest = clamp(dot(here, line) / max(dot(line, line), 1e-6), 0.0, 1.0);
  float distance = length(here - nearest * line);
  float coverage = clamp(0.5 * width + 0.5 - distance, 0.0, 1.0) * min(width, 1.0);
  if (coverage <= 0.0) discard;
  fragment = vec4(line_colour.rgb, line_colour.a * opacity * coverage);
}
