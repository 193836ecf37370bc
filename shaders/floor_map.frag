#version 330 core
#include "colour.glsl"
in vec2 offset;
flat in vec2 shape;
flat in vec3 tint;
out vec4 fragment;

// What passes a sphere above the floor: a cosine-weighted share of the sky, and some of its colour thrown back. In
// sRGB, where products are nearly those of linear space, so that nothing is left to convert where the map is read.
void main() {
  float height = shape.x, radius = shape.y;
  float squared = dot(offset, offset) + height * height;
  float hidden = min(height * inversesqrt(squared) * radius * radius / squared, 1.0);
  hidden *= 1.0 - smoothstep(2.5, 4.0, length(offset) / radius);
  fragment = vec4(srgb(1.0 - 0.80 * hidden * (1.0 - 0.30 * linear(tint))), 1.0);
}
