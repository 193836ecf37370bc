#include "frame.glsl"
#include "colour.glsl"
#include "backdrop.glsl"
#include "floor.glsl"
#include "shadow.glsl"
in vec3 world_position;
flat in vec3 world_normal;

// Looks like the floor. The more the plane turns away from the light, the darker it is.
void main() {
  float facing = clamp(dot(world_normal, frame.to_light.xyz) / frame.to_light.y, 0.0, 1.0);
  float lit = facing * light_visibility(world_position, world_normal);
  fragment = vec4(dithered(bare_floor() * mix(vec3(0.735, 0.745, 0.764), vec3(1.0), lit)), 1.0);
}
