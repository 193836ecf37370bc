uniform sampler2DShadow shadow_map;

// 1 in the light, 0 in the shadow. 16 taps, each blended from 2x2 texels, make an edge about seven texels wide.
float light_reaching(vec3 position, vec3 normal) {
  // Moved off the surface, most where the light grazes it, so that the surface does not shade itself.
  float grazing = 1.0 - max(dot(normal, frame.to_light.xyz), 0.0);
  vec3 at = (frame.shadow_from_world * vec4(position + normal * frame.to_light.w * (0.8 + 2.5 * grazing), 1.0)).xyz;
  float texel = 1.0 / float(textureSize(shadow_map, 0).x);
  float sum = 0.0;
  for (int i = 0; i < 16; ++i) {
    vec2 tap = (vec2(i & 3, i >> 2) - 1.5) * 1.5 * texel;
    sum += texture(shadow_map, vec3(at.xy + tap, min(at.z, 1.0)));
  }
  return sum / 16.0;
}
