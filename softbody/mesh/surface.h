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

/// Triangles connected by edges.
struct SurfacePart {
  std::vector<Index> faces;  // numbers of triangles
  bool closed;               // no edge has one face only
};

/// Turns triangles so that neighbours agree: in a closed part with most of its triangles, in an open one with the
/// first. Returns the parts. Throws SurfaceError if an edge has more than two faces, or if the surface has only one
/// side.
std::vector<SurfacePart> align(std::vector<Triangle>& triangles);

/// Returns the signed volume (m^3) of a closed part, as volume() does.
double volume(const std::vector<glm::dvec3>& vertices, const std::vector<Triangle>& triangles, const SurfacePart& part);

struct SurfaceFindings {
  std::size_t components = 0;    // parts connected by edges
  std::size_t cavities = 0;      // closed parts that face inwards
  std::size_t turned_faces = 0;  // triangles whose corners were reversed
  bool closed = false;           // all parts are
  bool operator==(const SurfaceFindings&) const = default;
};

/// Aligns triangles and turns every closed part outwards, so that its volume is positive, but for cavities: parts that
/// face inwards and lie wholly inside an odd number of other closed parts. Wholly inside means that all vertices are
/// inside and no edge of either part meets a face of the other. A cavity meets no closed part. Throws as align() does.
SurfaceFindings orient(std::vector<Triangle>& triangles, const std::vector<glm::dvec3>& vertices);

}  // namespace softbody
