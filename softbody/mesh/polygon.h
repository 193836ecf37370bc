#pragma once
// Cuts polygons into triangles.

#include <span>
#include <stdexcept>
#include <vector>

#include "softbody/mesh/mesh.h"

namespace softbody {

inline constexpr std::size_t max_polygon_corners = 1000;  // time grows with the cube of their number

/// Cuts a polygon of 3 or more corners into triangles by ear clipping (Meisters 1975); the ear with the shortest cut is
/// clipped first. The polygon may be concave and not quite flat. Indices are into `corners`. Every corner is used, even
/// on a straight line, and each side belongs to one triangle, so that neighbours stay connected. A polygon that crosses
/// itself is cut, too, but not in a defined way.
std::vector<Triangle> triangulate(std::span<const glm::dvec3> corners);

/// Polygons of one mesh, stored one after another. Each has 3 or more corners.
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
  std::vector<Index> polygon;       // the polygon of each triangle
};

/// Thrown if a polygon cannot be cut.
struct PolygonError : std::runtime_error {
  explicit PolygonError(std::size_t polygon_number)
      : std::runtime_error("no cut of a polygon is free"), polygon(polygon_number) {}
  std::size_t polygon;
};

/// Cuts polygons that share vertices. No cut runs along a side of a polygon or along a cut of another polygon, since
/// the edge would then have more than two faces. A polygon without such a conflict is cut as it would be alone. Throws
/// PolygonError if no such cuts are found; if all polygons have four corners at most, only if there are none.
Triangulation triangulate(const Polygons& polygons, std::span<const glm::dvec3> vertices);

}  // namespace softbody
