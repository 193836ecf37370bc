#version 330 core
#include "frame.glsl"
#include "body.glsl"
#include "occlusion.glsl"

layout(location = 3) in float radius;
layout(location = 4) in uvec2 occluder_range;
layout(location = 5) in vec3 colour;
uniform float recess;  // radii, by which it lies deeper than it is
out vec3 world_position;
out vec3 world_normal;
out vec3 bounce;
out float seen;
flat out vec3 albedo;

void main() {
  body_vertex(world_position, world_normal);
  seen = sky_seen(world_position, world_normal, occluder_range.x, occluder_range.y);
  bounce = floor_bounce(world_position, radius);
  albedo = colour;
  gl_Position = frame.clip_from_world * vec4(world_position, 1.0);
  if (recess > 0.0) {
    vec3 away = normalize(world_position - frame.eye.xyz);
    vec4 deeper = frame.clip_from_world * vec4(world_position + recess * radius * away, 1.0);
    gl_Position.z = deeper.z / deeper.w * gl_Position.w;
  }
}
