uniform sampler2DShadow shadow_map;

const int side = 6;

// Light at one of side x side places, 1.6 texels apart; the texture unit blends 2 x 2 texels for each.
float tap(vec3 at, int i) {
  vec2 place = (vec2(i % side, i / side) - 0.5 * float(side - 1)) * 1.6;
  return texture(shadow_map, vec3(at.xy + place / float(textureSize(shadow_map, 0).x), at.z));
}

// 1 in the light, 0 in the shadow, with an edge about ten texels wide.
float light_reaching(vec3 position, vec3 normal) {
  // Moved off the surface, most where the light grazes it, so that the surface does not shade itself.
  float grazing = 1.0 - max(dot(normal, frame.to_light.xyz), 0.0);
  vec3 at = (frame.shadow_from_world * vec4(position + normal * frame.to_light.w * (1.0 + 3.5 * grazing), 1.0)).xyz;
  at.z = min(at.z, 1.0);
  // Where the corners and the middle agree there is no edge. A loop of no turns is what every driver really skips.
  float first = tap(at, 0) + tap(at, side - 1) + tap(at, side * (side - 1)) + tap(at, side * side - 1) +
                texture(shadow_map, at);
  int taps = side * side * int(ceil(first * (5.0 - first) / 6.25));
  float sum = 0.0;
  for (int i = 0; i < taps; ++i) sum += tap(at, i);
  return taps == 0 ? first / 5.0 : sum / float(taps);
}
