#pragma once
// Where features of surfaces, vertices and faces, edges and edges, are closest to each other. In float, for contact
// that is solved many times a frame; the exact judge is surface_oracle.h.

#include <glm/vec3.hpp>

#include "collide/core/vertex_kernels.h"
#include "collide/surface/surface.h"

namespace collide::surface {

/// Where two features are closest, seen from the first one's side.
struct Closest {
  float weight[4];  // of the corners: vertex, three of the face; or two of one edge, two of the other. Each side's
                    // weights add up to 1.
  glm::vec3 apart;  // m, from the second feature's closest point to the first one's
  bool inner;       // both closest points lie inside their features, not on a border
};
/// Ericson (2005), Real-Time Collision Detection, sections 5.1.5 and 5.1.9. Degenerate faces and edges are as good as
/// others: the closest point lies on what is left of them. Faces with a corner's angle below 1e-3 are taken as their
/// sides, and edges within that angle as parallel: distances may then be too large by that share of their length.
Closest closest_vertex_face(const glm::vec3& vertex, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
Closest closest_edges(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r, const glm::vec3& s);  // pq, rs

}  // namespace collide::surface
