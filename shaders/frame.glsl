// Values that all shaders of a frame share. engine::render::FrameUniforms has the same layout.
layout(std140) uniform Frame {
  mat4 clip_from_world;
  mat4 shadow_from_world;  // to 0..1 in the shadow map
  vec4 eye;                // xyz; w: pixels per unit of width
  vec4 to_light;           // xyz, length 1; w: size of a shadow texel, m
  vec4 viewport;           // origin and size, pixels
  vec4 floor_map;          // centre x, centre z, 1 / extent, height of the floor
  vec4 scene;              // centre x, centre z, radius, distance between grid lines
  vec4 shadow_bounds;      // part of the shadow map that can hold shadows: min x, min y, max x, max y
  vec4 flags;              // x: 1 if there is a floor
} frame;

vec2 floor_map_coordinates(vec2 xz) { return (xz - frame.floor_map.xy) * frame.floor_map.z + 0.5; }
