#version 330 core
#include "frame.glsl"
#include "colour.glsl"
#include "backdrop.glsl"
#include "shadow.glsl"

uniform sampler2D floor_map;
in vec2 ground;
out vec4 fragment;

// How much of a pixel the lines `spacing` apart cover: of constant width on the screen, fewer in the distance.
float grid(float spacing) {
  vec2 at = ground / spacing;
  vec2 width = fwidth(at);
  vec2 lines = 1.0 - clamp(abs(fract(at - 0.5) - 0.5) / width - 0.35 * frame.eye.w + 0.5, 0.0, 1.0);
  vec2 room = 1.0 - smoothstep(0.04, 0.30, width);
  return max(lines.x * room.x, lines.y * room.y);
}

void main() {
  vec3 wall = backdrop();
  float distance = length(ground - frame.scene.xy) / frame.scene.z;
  float near = 1.0 - smoothstep(1.0, 7.0, distance);
  vec3 base = mix(wall, vec3(0.885, 0.888, 0.892), near);
  base *= 1.0 - near * (0.055 * grid(frame.scene.w) + 0.035 * grid(0.2 * frame.scene.w));

  float lit = light_reaching(vec3(ground.x, frame.floor_map.w, ground.y), vec3(0.0, 1.0, 0.0));
  vec3 sky = texture(floor_map, floor_map_coordinates(ground)).rgb;
  vec3 light = mix(vec3(0.50, 0.515, 0.545), vec3(1.0), lit) * sky;
  fragment = vec4(dithered(srgb(linear(base) * light)), 1.0);
}
