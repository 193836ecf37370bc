#version 330 core
// A patch of a plane: the face y = 1 of a cube.
#include "frame.glsl"
layout(location = 0) in vec3 place;
layout(location = 2) in vec3 centre;
layout(location = 3) in mat3 half_axes;
out vec3 world_position;
flat out vec3 world_normal;
out vec2 ground;  // along the plane, as if it were the floor

void main() {
  world_position = centre + half_axes * place;
  world_normal = half_axes[1];
  ground = frame.scene.xy + place.xz * vec2(length(half_axes[0]), length(half_axes[2]));
  gl_Position = frame.clip_from_world * vec4(world_position, 1.0);
}
