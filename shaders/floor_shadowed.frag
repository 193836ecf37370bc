#version 330 core
#include "frame.glsl"
#include "colour.glsl"
#include "backdrop.glsl"
#include "floor.glsl"
#include "shadow.glsl"
uniform sampler2D floor_map;

// Where shadows may fall.
void main() {
  float lit = light_reaching(vec3(ground.x, frame.floor_map.w, ground.y), vec3(0.0, 1.0, 0.0));
  vec3 sky = texture(floor_map, floor_map_coordinates(ground)).rgb;
  fragment = vec4(dithered(bare_floor() * sky * mix(vec3(0.735, 0.745, 0.764), vec3(1.0), lit)), 1.0);
}
