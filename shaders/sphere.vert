#include "frame.glsl"
#include "table.glsl"
#include "ambient.glsl"

layout(location = 0) in vec3 direction;
layout(location = 1) in vec4 sphere;  // centre, radius
layout(location = 2) in uvec2 occluder_range;
layout(location = 3) in vec3 colour;
layout(location = 4) in vec3 segment;  // axis of a capsule; 0 for a sphere
out vec3 world_position;
out vec3 world_normal;
out vec3 bounce;
out float sky_visibility;
flat out vec3 albedo;

void main() {
  world_position = sphere.xyz + sphere.w * direction + step(0.0, dot(direction, segment)) * segment;
  world_normal = direction;
  sky_visibility = visible_sky(world_position, direction, occluder_range.x, occluder_range.y);
  bounce = floor_bounce(world_position, sphere.w);
  albedo = colour;
  gl_Position = frame.clip_from_world * vec4(world_position, 1.0);
}
