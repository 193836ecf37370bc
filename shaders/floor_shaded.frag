#version 330 core
#include "frame.glsl"
#include "colour.glsl"
#include "backdrop.glsl"
#include "floor.glsl"
uniform sampler2D floor_map;

// Where bodies hide part of the sky, but cast no shadow.
void main() {
  vec3 sky = texture(floor_map, floor_map_coordinates(ground)).rgb;
  fragment = vec4(dithered(bare_floor() * sky), 1.0);
}
