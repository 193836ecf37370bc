#include "frame.glsl"
#include "colour.glsl"
#include "backdrop.glsl"
#include "floor.glsl"
uniform sampler2D floor_map;

// Floor with ambient occlusion, without shadows.
void main() {
  vec3 sky = texture(floor_map, floor_map_coordinates(floor_position)).rgb;
  fragment = vec4(dithered(bare_floor() * sky), 1.0);
}
