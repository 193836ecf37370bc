#version 330 core
#include "frame.glsl"
layout(location = 0) in vec2 place;  // x, z
out vec2 ground;

void main() {
  ground = place;
  gl_Position = frame.clip_from_world * vec4(place.x, frame.floor_map.w, place.y, 1.0);
}
