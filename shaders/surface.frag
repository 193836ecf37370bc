#version 330 core
// Matte rubber: diffuse light with a shadow, light from the sky and the floor, a soft highlight and a faint rim.
#include "frame.glsl"
#include "colour.glsl"
#include "shadow.glsl"

in vec3 world_position;
in vec3 world_normal;
in vec3 bounce;
in float seen;
flat in vec3 albedo;
uniform float opacity = 1.0;
out vec4 fragment;

float power4(float x) {
  float square = x * x;
  return square * square;
}

void main() {
  vec3 normal = normalize(world_normal) * (gl_FrontFacing ? 1.0 : -1.0);
  vec3 to_eye = normalize(frame.eye.xyz - world_position);
  vec3 half_way = normalize(to_eye + frame.to_light.xyz);
  vec3 base = linear(albedo);

  // Lambert's law, but coming to 0 smoothly: the edge of the light on a sphere is soft.
  float cosine = max(dot(normal, frame.to_light.xyz), 0.0);
  float facing = 1.1 * cosine * cosine / (cosine + 0.1);
  float lit = light_reaching(world_position, normal);
  vec3 key = vec3(0.86, 0.83, 0.79) * facing * lit;
  vec3 sky = vec3(0.40, 0.43, 0.48) * seen;
  vec3 floor_light = vec3(0.34, 0.33, 0.32) * bounce * (0.35 + 0.65 * seen);
  vec3 colour = base * (key + mix(floor_light, sky, 0.5 + 0.5 * normal.y));

  float gloss = power4(max(dot(normal, half_way), 0.0));
  gloss = power4(gloss) * gloss * gloss * gloss;  // to the 28th
  float edge = power4(1.0 - max(dot(normal, to_eye), 0.0));
  colour += vec3(0.10) * gloss * lit * facing + vec3(0.09, 0.10, 0.11) * edge * seen * (0.5 + 0.5 * normal.y);
  fragment = vec4(dithered(srgb(shoulder(colour))), opacity);
}
