#pragma once
// Polygons cut into triangles.

#include <span>

#include "softbody/mesh.h"

namespace softbody {

inline constexpr std::size_t max_polygon_corners = 1000;  // time grows with the cube of their number

/// The triangles of a polygon that may be concave and not quite flat, by clipping ears (Meisters 1975), of several the
/// one with the shortest cut first. Indices are into `corners`; every corner is used, those on a straight line too, and
/// each side belongs to one triangle, so that neighbours stay joined. A polygon that crosses itself is cut somehow. 3
/// or more corners.
std::vector<Triangle> triangulate(std::span<const glm::dvec3> corners);

}  // namespace softbody
