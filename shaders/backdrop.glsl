// Colour (sRGB) of the studio wall behind the scene at this pixel. The floor fades into it.
vec3 backdrop() {
  vec2 p = (gl_FragCoord.xy - frame.viewport.xy) / frame.viewport.zw;
  vec3 wall = mix(vec3(0.905, 0.910, 0.918), vec3(0.765, 0.790, 0.822), smoothstep(0.25, 1.1, p.y));
  float vignette = length((p - vec2(0.5, 0.45)) * vec2(1.0, 0.8));
  return wall * (1.0 - 0.10 * smoothstep(0.35, 0.95, vignette));
}
