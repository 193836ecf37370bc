#pragma once
// Checks that triangles form a surface, and finds its outer side.

#include <stdexcept>
#include <utility>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody {

/// Thrown if triangles form no surface that a body can have; what() says why.
struct SurfaceError : std::runtime_error {
  SurfaceError(const char* why, Edge where, std::vector<Index> there)
      : std::runtime_error(why), edge(where), triangles(std::move(there)) {}
  Edge edge;                     // an edge at which the fault shows
  std::vector<Index> triangles;  // the triangles at this edge: two if the surface has one side only, else more
};

struct SurfaceFindings {
  std::size_t components = 0;    // parts connected by edges
  std::size_t turned_faces = 0;  // triangles whose corners were reversed
  std::size_t border_edges = 0;  // edges with one face only; 0: the surface is closed
};

/// Orients triangles so that neighbours agree and every closed component has a positive volume. A cavity inside a body
/// counts as a body of its own. An open component keeps the orientation of its first triangle. Throws SurfaceError if
/// an edge has more than two faces, or if the surface has only one side.
SurfaceFindings orient(std::vector<Triangle>& triangles, const std::vector<glm::dvec3>& vertices);

}  // namespace softbody
