#include "frame.glsl"
#include "table.glsl"
#include "body.glsl"
#include "ambient.glsl"

layout(location = 3) in float radius;
layout(location = 4) in uvec2 occluder_range;
layout(location = 5) in vec3 colour;
uniform sampler2D marks;
out vec3 world_position;
out vec3 world_normal;
out vec3 bounce;
out float sky_visibility;
out float mark;
flat out vec3 albedo;

void main() {
  body_vertex(world_position, world_normal);
  sky_visibility = visible_sky(world_position, world_normal, occluder_range.x, occluder_range.y);
  bounce = floor_bounce(world_position, radius);
  mark = body_value(marks);
  albedo = colour;
  gl_Position = frame.clip_from_world * vec4(world_position, 1.0);
}
