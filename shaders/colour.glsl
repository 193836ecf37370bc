// Colours are read and written as sRGB; light is added in linear space. Both conversions are fits without costly
// powers. Except for the darkest tones, they differ from the definition by less than one 8-bit step.
vec3 linear_from_srgb(vec3 s) { return s * (s * (s * 0.305306011 + 0.682171111) + 0.012522878); }

vec3 srgb_from_linear(vec3 linear) {
  vec3 root = sqrt(max(linear, 0.0));
  return root * (root * (root * 0.132252 - 0.392595) + 1.282034) - 0.021691;
}

// Bends bright values towards white, so that they are not cut off at 1.
vec3 compress_highlights(vec3 c) {
  vec3 over = max(c - 0.75, 0.0);
  vec3 room = max(1.0 - 0.5 * over, 0.0), room2 = room * room, room4 = room2 * room2;
  return min(c, 0.75) + 0.25 * (1.0 - room4 * room4);
}

// Adds up to half an 8-bit step of noise, so that slow gradients show no bands.
vec3 dithered(vec3 c) {
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return c + (noise - 0.5) / 255.0;
}
