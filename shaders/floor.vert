#include "frame.glsl"
layout(location = 0) in vec2 position;  // x, z
out vec2 floor_position;

void main() {
  floor_position = position;
  gl_Position = frame.clip_from_world * vec4(position.x, frame.floor_map.w, position.y, 1.0);
}
