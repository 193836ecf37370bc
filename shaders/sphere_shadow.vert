layout(location = 0) in vec3 direction;
layout(location = 1) in vec4 sphere;
layout(location = 4) in vec3 segment;
uniform mat4 light_clip_from_world;

void main() {
  vec3 position = sphere.xyz + sphere.w * direction + step(0.0, dot(direction, segment)) * segment;
  gl_Position = light_clip_from_world * vec4(position, 1.0);
}
