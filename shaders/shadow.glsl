uniform sampler2DShadow shadow_map;

const float spacing = 2.0;  // texels between taps

// Light at a place some taps away; the texture unit blends 2 x 2 texels.
float tap(vec3 at, vec2 taps) {
  return texture(shadow_map, vec3(at.xy + taps * (spacing / float(textureSize(shadow_map, 0).x)), at.z));
}

// 1 in the light, 0 in the shadow of something else, with an edge six texels wide: the mean of 3 x 3 taps. Loops of no
// turns, unlike branches, are what every driver really skips.
float light_reaching(vec3 position, vec3 normal) {
  // Moved off the surface, so that it does not shade itself within the filter's reach of three texels.
  float cosine = dot(normal, frame.to_light.xyz);
  float off = 0.5 + 2.5 * sqrt(max(1.0 - cosine * cosine, 0.0));
  vec3 at = (frame.shadow_from_world * vec4(position + normal * frame.to_light.w * off, 1.0)).xyz;
  at.z = min(at.z, 1.0);
  // First the corners, and not even those where nothing casts a shadow or no light arrives anyway.
  vec2 inside = step(frame.casters.xy, at.xy) * step(at.xy, frame.casters.zw);
  int corners = int(4.0 * inside.x * inside.y * step(0.0, cosine));
  float light = 4.0 - float(corners);
  for (int i = 0; i < corners; ++i) light += tap(at, vec2(i & 1, i >> 1) * 2.0 - 1.0);
  // Where they agree there is no edge; elsewhere the five between them count as well.
  int others = 5 * int(ceil(light * (4.0 - light) * 0.25));
  for (int i = 0; i < others; ++i) light += tap(at, i < 2 ? vec2(2 * i - 1, 0) : vec2(0, i - 3));
  return light / (4.0 + float(others));
}
