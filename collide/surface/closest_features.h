#pragma once
// Finds the closest points of two features of surfaces: of a vertex and a face, or of two edges. In float, for contact
// that is solved many times a frame; the exact test is surface_oracle.h.

#include <glm/vec3.hpp>

#include "collide/core/vertex_kernels.h"
#include "collide/surface/surface.h"

namespace collide::surface {

/// The closest points of two features.
struct Closest {
  float weight[4];  // barycentric coordinates of the points: of the vertex (1) and the three corners of the face, or
                    // of the two ends of each edge. The weights of each feature add up to 1.
  glm::vec3 separation;  // m, from the closest point of the second feature to that of the first
  bool inner;            // both points lie inside their features, not on a border
};
/// Return the closest points of a vertex and a face abc, and of two edges pq and rs. Ericson (2005), Real-Time
/// Collision Detection, sections 5.1.5 and 5.1.9. Faces and edges may be degenerate: a face may be a line or a point,
/// and an edge a point. A face with an angle below 1e-3 is treated as its three sides, and edges at an angle below 1e-3
/// are treated as parallel: the distance may then be too large by 1e-3 times their length.
Closest closest_vertex_face(const glm::vec3& vertex, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
Closest closest_edges(const glm::vec3& p, const glm::vec3& q, const glm::vec3& r, const glm::vec3& s);

}  // namespace collide::surface
