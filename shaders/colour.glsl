// Colours come and go as sRGB; light adds up in linear space. Both ways are fits without costly powers, within half a
// step of 8 bits of the definition but for the darkest tones.
vec3 linear(vec3 s) { return s * (s * (s * 0.305306011 + 0.682171111) + 0.012522878); }

vec3 srgb(vec3 linear) {
  vec3 root2 = sqrt(max(linear, 0.0)), root4 = sqrt(root2);
  return 0.585122381 * root2 + 0.783140355 * root4 - 0.368262736 * sqrt(root4);
}

// Bright values bend towards white instead of being cut off.
vec3 shoulder(vec3 c) { return mix(c, 1.0 - 0.25 * exp(-(c - 0.75) / 0.25), step(0.75, c)); }

// Half a step of an 8-bit channel, up or down by place, so that slow gradients show no bands.
vec3 dithered(vec3 c) {
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return c + (noise - 0.5) / 255.0;
}
