#include "colour.glsl"
in vec2 offset;
flat in vec2 height_and_radius;
flat in vec3 tint;
out vec4 fragment;

// Light of the sky that a sphere leaves to the floor: 1 minus the cosine-weighted share that it hides, plus some of
// that share thrown back in the sphere's colour. Stored as sRGB, so that the shaders that read it need not convert:
// products of sRGB values are close to those in linear space.
void main() {
  float height = height_and_radius.x, radius = height_and_radius.y;
  float squared = dot(offset, offset) + height * height;
  float occlusion = min(height * inversesqrt(squared) * radius * radius / squared, 1.0);
  occlusion *= 1.0 - smoothstep(2.5, 4.0, length(offset) / radius);
  fragment = vec4(srgb_from_linear(1.0 - 0.80 * occlusion * (1.0 - 0.30 * linear_from_srgb(tint))), 1.0);
}
