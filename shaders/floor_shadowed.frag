#include "frame.glsl"
#include "colour.glsl"
#include "backdrop.glsl"
#include "floor.glsl"
#include "shadow.glsl"
uniform sampler2D floor_map;

// Floor with ambient occlusion and shadows.
void main() {
  float lit = light_visibility(vec3(floor_position.x, frame.floor_map.w, floor_position.y), vec3(0.0, 1.0, 0.0));
  vec3 sky = texture(floor_map, floor_map_coordinates(floor_position)).rgb;
  fragment = vec4(dithered(bare_floor() * sky * mix(vec3(0.735, 0.745, 0.764), vec3(1.0), lit)), 1.0);
}
