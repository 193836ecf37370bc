#version 330 core
// A large square round the scene.
#include "frame.glsl"
out vec2 ground;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  ground = frame.scene.xy + corner * 12.0 * frame.scene.z;
  gl_Position = frame.clip_from_world * vec4(ground.x, frame.floor_map.w, ground.y, 1.0);
}
