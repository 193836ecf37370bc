// Colours come and go as sRGB; light adds up in linear space. Both ways are fits without costly powers, within a step
// of 8 bits of the definition but for the darkest tones.
vec3 linear(vec3 s) { return s * (s * (s * 0.305306011 + 0.682171111) + 0.012522878); }

vec3 srgb(vec3 linear) {
  vec3 root = sqrt(max(linear, 0.0));
  return root * (root * (root * 0.132252 - 0.392595) + 1.282034) - 0.021691;
}

// Bright values bend towards white instead of being cut off.
vec3 shoulder(vec3 c) {
  vec3 over = max(c - 0.75, 0.0);
  vec3 room = max(1.0 - 0.5 * over, 0.0), room2 = room * room, room4 = room2 * room2;
  return min(c, 0.75) + 0.25 * (1.0 - room4 * room4);
}

// Half a step of an 8-bit channel, up or down by place, so that slow gradients show no bands.
vec3 dithered(vec3 c) {
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return c + (noise - 0.5) / 255.0;
}
