uniform sampler2DShadow shadow_map;

// 1 in the light, 0 in the shadow of something else, with an edge four texels wide: the mean of 2 x 2 taps, each of
// which the texture unit blends from 2 x 2 texels.
float light_reaching(vec3 position, vec3 normal) {
  // Moved off the surface, so that it does not shade itself within the filter's reach of two texels.
  float cosine = dot(normal, frame.to_light.xyz);
  float off = 0.5 + 2.0 * sqrt(max(1.0 - cosine * cosine, 0.0));
  vec3 at = (frame.shadow_from_world * vec4(position + normal * frame.to_light.w * off, 1.0)).xyz;
  at.z = min(at.z, 1.0);
  // None where nothing casts a shadow or no light arrives anyway. Loops of no turns, unlike branches, are what every
  // driver really skips.
  vec2 inside = step(frame.casters.xy, at.xy) * step(at.xy, frame.casters.zw);
  int taps = int(4.0 * inside.x * inside.y * step(0.0, cosine));
  float light = 4.0 - float(taps), texel = 1.0 / float(textureSize(shadow_map, 0).x);
  for (int i = 0; i < taps; ++i) {
    light += texture(shadow_map, at + vec3(vec2(i & 1, i >> 1) * 2.0 - 1.0, 0.0) * texel);
  }
  return 0.25 * light;
}
