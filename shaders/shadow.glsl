uniform sampler2DShadow shadow_map;

const int side = 5;
const float spacing = 2.0;  // texels

// Light at a place `texels` away; the texture unit blends 2 x 2 texels.
float tap(vec3 at, vec2 texels) {
  return texture(shadow_map, vec3(at.xy + texels / float(textureSize(shadow_map, 0).x), at.z));
}

// 1 in the light, 0 in the shadow of something else, with an edge about ten texels wide. Loops of no turns, unlike
// branches, are what every driver really skips.
float light_reaching(vec3 position, vec3 normal) {
  // Moved off the surface, so that it does not shade itself within the filter's reach of four texels.
  float cosine = dot(normal, frame.to_light.xyz);
  float off = 0.75 + 4.25 * sqrt(max(1.0 - cosine * cosine, 0.0));
  vec3 at = (frame.shadow_from_world * vec4(position + normal * frame.to_light.w * off, 1.0)).xyz;
  at.z = min(at.z, 1.0);
  // First the middle and the four corners, and not even those where nothing casts a shadow or no light arrives anyway.
  vec2 inside = step(frame.casters.xy, at.xy) * step(at.xy, frame.casters.zw);
  int probes = int(5.0 * inside.x * inside.y * step(0.0, cosine));
  float reach = spacing * float(side - 1);
  float agreeing = 5.0 - float(probes);
  for (int i = 0; i < probes; ++i) agreeing += tap(at, i == 4 ? vec2(0.0) : (vec2(i & 1, i >> 1) - 0.5) * reach);
  // Where they agree there is no edge.
  int taps = side * side * int(ceil(agreeing * (5.0 - agreeing) / 6.25));
  float sum = 0.0;
  for (int i = 0; i < taps; ++i) sum += tap(at, vec2(i % side, i / side) * spacing - 0.5 * reach);
  return taps == 0 ? agreeing / 5.0 : sum / float(taps);
}
