uniform samplerBuffer occluders;  // spheres: centre, radius
uniform sampler2D floor_map;      // how much of the sky the floor sees, tinted by what is in the way (sRGB)

// Part of the sky that `count` spheres from `first` on leave to a point (Quilez, "sphere ambient occlusion"). Their
// share falls to nothing at 2.2 of their radii, so that none is missed when it leaves the list.
float sky_seen(vec3 position, vec3 normal, uint first, uint count) {
  const float least = 1.0 / (2.2 * 2.2);
  float seen = 1.0;
  for (uint i = 0u; i < count; ++i) {
    vec4 sphere = texelFetch(occluders, int(first + i));
    vec3 to = sphere.xyz - position;
    float squared = max(dot(to, to), sphere.w * sphere.w);
    float share = max((sphere.w * sphere.w / squared - least) / (1.0 - least), 0.0);
    float facing = max(dot(normal, to) * inversesqrt(squared) * 0.8 + 0.2, 0.0);
    seen *= 1.0 - 0.85 * facing * share;
  }
  return seen;
}

// Light that the floor throws back up: little from right under a body.
vec3 floor_bounce(vec3 position, float reach) {
  if (frame.flags.x == 0.0) return vec3(0.6);
  vec3 lit = texture(floor_map, floor_map_coordinates(position.xz)).rgb;
  lit *= lit;  // linear, nearly
  float height = max(position.y - frame.floor_map.w, 0.0);
  return mix(lit * lit, vec3(1.0), smoothstep(0.0, 2.0, height / reach));
}
