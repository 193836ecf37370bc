// The floor without shadows and ambient occlusion.
in vec2 floor_position;  // x, z
out vec4 fragment;

// Share of the pixel that is covered by the lines at whole numbers. The lines have a constant width on the screen and
// vanish in the distance.
float grid(vec2 at, vec2 pixel, vec2 pixels_per_cell) {
  vec2 lines = 1.0 - clamp(abs(fract(at - 0.5) - 0.5) * pixels_per_cell - 0.35 * frame.eye.w + 0.5, 0.0, 1.0);
  vec2 fade = 1.0 - smoothstep(0.04, 0.30, pixel);
  return max(lines.x * fade.x, lines.y * fade.y);
}

// Colour in full light (sRGB).
vec3 bare_floor() {
  float distance = length(floor_position - frame.scene.xy) / frame.scene.z;
  float near = 1.0 - smoothstep(1.0, 7.0, distance);
  vec2 at = floor_position / frame.scene.w, pixel = fwidth(at), pixels_per_cell = 1.0 / pixel;
  float lines = 0.055 * grid(at, pixel, pixels_per_cell) + 0.035 * grid(5.0 * at, 5.0 * pixel, 0.2 * pixels_per_cell);
  return mix(backdrop(), vec3(0.885, 0.888, 0.892), near) * (1.0 - near * lines);
}
