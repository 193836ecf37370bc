// One vertex of a body: a point in a triangle of its mesh, moved outwards so that the outline is round.
layout(location = 0) in uvec3 corners;
layout(location = 1) in vec2 weights;
layout(location = 2) in uint first_vertex;
uniform sampler2D positions;  // tables with one value per vertex
uniform sampler2D normals;

vec3 fetch(sampler2D table, uint vertex) { return table_value(table, int(first_vertex + vertex)).xyz; }

// A value of each vertex, interpolated linearly.
float body_value(sampler2D table) {
  vec3 values;
  for (int i = 0; i < 3; ++i) values[i] = table_value(table, int(first_vertex + corners[i])).r;
  return dot(values, vec3(weights, 1.0 - weights.x - weights.y));
}

// Phong tessellation (Boubekeur and Alexa 2008). The factor 1/2 puts the middle of an edge of a sphere onto the sphere.
void body_vertex(out vec3 position, out vec3 normal) {
  vec3 p0 = fetch(positions, corners.x), n0 = fetch(normals, corners.x);
  position = p0;
  normal = n0;
  // No turn for a vertex of the mesh. A loop, because some drivers run both sides of a branch.
  for (int turns = corners.x == corners.y ? 0 : 1; turns > 0; --turns) {
    vec3 p1 = fetch(positions, corners.y), n1 = fetch(normals, corners.y);
    vec3 p2 = fetch(positions, corners.z), n2 = fetch(normals, corners.z);
    vec3 w = vec3(weights, 1.0 - weights.x - weights.y);
    vec3 flat_point = w.x * p0 + w.y * p1 + w.z * p2;
    position = flat_point - 0.5 * (w.x * dot(flat_point - p0, n0) * n0 + w.y * dot(flat_point - p1, n1) * n1 +
                                   w.z * dot(flat_point - p2, n2) * n2);
    normal = normalize(w.x * n0 + w.y * n1 + w.z * n2);
  }
}
