#version 330 core
uniform float width;
uniform float opacity;
noperspective in vec2 along_across;
flat in float span;
flat in vec4 line_colour;
out vec4 fragment;

void main() {
  float beyond = max(max(-along_across.x, along_across.x - span), 0.0);
  float distance = length(vec2(beyond, along_across.y));
  float cover = clamp(0.5 * width + 0.5 - distance, 0.0, 1.0) * min(width, 1.0);
  if (cover <= 0.0) discard;
  fragment = vec4(line_colour.rgb, line_colour.a * opacity * cover);
}
