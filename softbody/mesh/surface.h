#pragma once
// Whether triangles form a surface, and which side of it is out.

#include <stdexcept>
#include <utility>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody {

/// The triangles are no surface that a body can have; what() says why.
struct SurfaceError : std::runtime_error {
  SurfaceError(const char* why, Edge where, std::vector<Index> there)
      : std::runtime_error(why), edge(where), triangles(std::move(there)) {}
  Edge edge;                     // where it shows
  std::vector<Index> triangles;  // that have it: two if the surface has one side, else more
};

struct SurfaceFindings {
  std::size_t components = 0;    // joined by edges
  std::size_t turned_faces = 0;  // those whose corners were put in the other order
  std::size_t border_edges = 0;  // with one face only; none: closed
};

/// Turns triangles so that neighbours agree and every closed component has positive volume: a hole inside a body counts
/// as a body of its own. An open component keeps the side of its first triangle. Throws SurfaceError if an edge has
/// more than two faces, or if the surface has only one side.
SurfaceFindings orient(std::vector<Triangle>& triangles, const std::vector<glm::dvec3>& vertices);

}  // namespace softbody
