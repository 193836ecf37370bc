// Light from the sky and from the floor.
uniform sampler2D occluders;  // a table of spheres: centre, radius
uniform sampler2D floor_map;  // light of the sky that reaches the floor (sRGB)

// Share of the sky that a point sees past `count` spheres, from the sphere `first` on (Quilez, "sphere ambient
// occlusion"). A sphere's share falls to 0 at 2.2 of its radii, so that nothing jumps when it leaves the list.
float visible_sky(vec3 position, vec3 normal, uint first, uint count) {
  const float min_share = 1.0 / (2.2 * 2.2);
  float visibility = 1.0;
  for (uint i = 0u; i < count; ++i) {
    vec4 sphere = table_value(occluders, int(first + i));
    vec3 to = sphere.xyz - position;
    float squared = max(dot(to, to), sphere.w * sphere.w);
    float share = max((sphere.w * sphere.w / squared - min_share) / (1.0 - min_share), 0.0);
    float facing = max(dot(normal, to) * inversesqrt(squared) * 0.8 + 0.2, 0.0);
    visibility *= 1.0 - 0.85 * facing * share;
  }
  return visibility;
}

// Light that the floor reflects upwards. It is dark directly below a body and full at two `radius` above the floor.
vec3 floor_bounce(vec3 position, float radius) {
  if (frame.flags.x == 0.0) return vec3(0.6);
  vec3 lit = texture(floor_map, floor_map_coordinates(position.xz)).rgb;
  lit *= lit;  // nearly linear
  float height = max(position.y - frame.floor_map.w, 0.0);
  return mix(lit * lit, vec3(1.0), smoothstep(0.0, 2.0, height / radius));
}
