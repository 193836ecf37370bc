#include "frame.glsl"
#include "table.glsl"
#include "ambient.glsl"
#include "cube.glsl"

layout(location = 0) in vec3 centre;
layout(location = 1) in mat3 half_axes;
layout(location = 4) in vec3 colour;
out vec3 world_position;
out vec3 world_normal;
out vec3 bounce;
out float sky_visibility;
flat out vec3 albedo;

void main() {
  world_position = centre + half_axes * cube_position();
  world_normal = normalize(half_axes * cube_normal());
  sky_visibility = 1.0;
  bounce = floor_bounce(world_position, 0.5);
  albedo = colour;
  gl_Position = frame.clip_from_world * vec4(world_position, 1.0);
}
