#include "table.glsl"
#include "body.glsl"
uniform mat4 light_clip_from_world;

void main() {
  vec3 position, normal;
  body_vertex(position, normal);
  gl_Position = light_clip_from_world * vec4(position, 1.0);
}
