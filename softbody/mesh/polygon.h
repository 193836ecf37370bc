#pragma once
// Polygons cut into triangles.

#include <span>
#include <stdexcept>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody {

inline constexpr std::size_t max_polygon_corners = 1000;  // time grows with the cube of their number

/// The triangles of a polygon that may be concave and not quite flat, by clipping ears (Meisters 1975), of several the
/// one with the shortest cut first. Indices are into `corners`; every corner is used, those on a straight line too, and
/// each side belongs to one triangle, so that neighbours stay joined. A polygon that crosses itself is cut somehow. 3
/// or more corners.
std::vector<Triangle> triangulate(std::span<const glm::dvec3> corners);

/// Polygons of one mesh, each of 3 or more corners, one after another.
struct Polygons {
  std::vector<Index> corners;     // numbers of vertices
  std::vector<std::size_t> ends;  // of each polygon in `corners`

  std::size_t size() const { return ends.size(); }
  std::span<const Index> operator[](std::size_t i) const {
    const std::size_t begin = i > 0 ? ends[i - 1] : 0;
    return std::span(corners).subspan(begin, ends[i] - begin);
  }
};

struct Triangulation {
  std::vector<Triangle> triangles;  // each with three different vertices
  std::vector<Index> polygon;       // of each triangle
};

/// A polygon cannot be cut.
struct PolygonError : std::runtime_error {
  explicit PolygonError(std::size_t polygon_number)
      : std::runtime_error("no cut of a polygon is free"), polygon(polygon_number) {}
  std::size_t polygon;
};

/// Cuts polygons that share vertices. No cut runs along a side of a polygon or along a cut of another one, since edges
/// would have more than two faces; polygons where this asks for no other cuts are cut as each would be by itself.
/// Throws PolygonError if no such cuts are found: for polygons of four corners only if there are none.
Triangulation triangulate(const Polygons& polygons, std::span<const glm::dvec3> vertices);

}  // namespace softbody
