// The cube from -1 to 1: 36 vertices, told apart by gl_VertexID, counter-clockwise from outside. The faces follow one
// another in the order -x, x, -y, y, -z, z.

vec3 cube_normal() {
  int face = gl_VertexID / 6;
  vec3 normal = vec3(0.0);
  normal[face >> 1] = (face & 1) == 0 ? -1.0 : 1.0;
  return normal;
}

vec3 cube_position() {
  int axis = gl_VertexID / 12, corner = gl_VertexID % 6;
  vec2 uv = vec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5) * 2.0 - 1.0;
  vec3 position = cube_normal();
  if (position[axis] < 0.0) uv = uv.yx;  // counter-clockwise from outside
  position[(axis + 1) % 3] = uv.x;
  position[(axis + 2) % 3] = uv.y;
  return position;
}
