// A patch of a plane: the face y = 1 of a cube.
#include "frame.glsl"
#include "cube.glsl"
layout(location = 0) in vec3 centre;
layout(location = 1) in mat3 half_axes;
out vec3 world_position;
flat out vec3 world_normal;
out vec2 floor_position;  // coordinates along the plane, for floor.glsl

void main() {
  world_position = centre + half_axes * cube_position();
  world_normal = half_axes[1];
  floor_position = frame.scene.xy + cube_position().xz * vec2(length(half_axes[0]), length(half_axes[2]));
  gl_Position = frame.clip_from_world * vec4(world_position, 1.0);
}
