uniform sampler2DShadow shadow_map;

const float spacing = 2.0;  // texels between taps

// Shadow-map test at `at`, moved by `taps`; the texture unit blends 2 x 2 texels.
float tap(vec3 at, vec2 taps) {
  return texture(shadow_map, vec3(at.xy + taps * (spacing / float(textureSize(shadow_map, 0).x)), at.z));
}

// 1 in the light, 0 in shadow; the edge between is six texels wide (percentage-closer filter of 3 x 3 taps). A tap is
// skipped by a loop of zero turns, because some drivers run both sides of a branch.
float light_visibility(vec3 position, vec3 normal) {
  // Moved off the surface, so that the surface does not shadow itself within the filter's three texels.
  float cosine = dot(normal, frame.to_light.xyz);
  float off = 0.5 + 2.5 * sqrt(max(1.0 - cosine * cosine, 0.0));
  vec3 at = (frame.shadow_from_world * vec4(position + normal * frame.to_light.w * off, 1.0)).xyz;
  at.z = min(at.z, 1.0);
  // The corners come first. They are skipped where nothing casts a shadow and where the surface faces away.
  vec2 inside = step(frame.shadow_bounds.xy, at.xy) * step(at.xy, frame.shadow_bounds.zw);
  int corners = int(4.0 * inside.x * inside.y * step(0.0, cosine));
  float light = 4.0 - float(corners);
  for (int i = 0; i < corners; ++i) light += tap(at, vec2(i & 1, i >> 1) * 2.0 - 1.0);
  // The other five taps are needed only if the corners disagree, that is, at an edge.
  int others = 5 * int(ceil(light * (4.0 - light) * 0.25));
  for (int i = 0; i < others; ++i) light += tap(at, i < 2 ? vec2(2 * i - 1, 0) : vec2(0, i - 3));
  return light / (4.0 + float(others));
}
