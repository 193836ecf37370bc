// The bare floor.
in vec2 ground;
out vec4 fragment;

// How much of a pixel the lines at whole numbers cover: of constant width on the screen, fewer in the distance.
float grid(vec2 at, vec2 pixel, vec2 pixels_a_cell) {
  vec2 lines = 1.0 - clamp(abs(fract(at - 0.5) - 0.5) * pixels_a_cell - 0.35 * frame.eye.w + 0.5, 0.0, 1.0);
  vec2 room = 1.0 - smoothstep(0.04, 0.30, pixel);
  return max(lines.x * room.x, lines.y * room.y);
}

// Its colour in full light (sRGB).
vec3 bare_floor() {
  float distance = length(ground - frame.scene.xy) / frame.scene.z;
  float near = 1.0 - smoothstep(1.0, 7.0, distance);
  vec2 at = ground / frame.scene.w, pixel = fwidth(at), pixels_a_cell = 1.0 / pixel;
  float lines = 0.055 * grid(at, pixel, pixels_a_cell) + 0.035 * grid(5.0 * at, 5.0 * pixel, 0.2 * pixels_a_cell);
  return mix(backdrop(), vec3(0.885, 0.888, 0.892), near) * (1.0 - near * lines);
}
