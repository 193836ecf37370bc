#pragma once
// Tells of points whether they lie inside a closed surface, and which face is nearest to them. In float and double, for
// contact; the exact test is surface_oracle.h.

#include "collide/core/vertex_run.h"
#include "collide/surface/box_tree.h"
#include "collide/surface/surface.h"

namespace collide::surface {

/// A closed surface at fixed positions.
class ClosedShell {
 public:
  /// at: the positions of the vertices, as many as the surface has. They and the surface must outlive this object. If
  /// one is not finite, no point is inside.
  ClosedShell(const Surface& surface, const VertexRun& at);

  /// Returns true if a ray from the point crosses the surface an odd number of times. A point on the surface may count
  /// either way.
  bool inside(const glm::vec3& point) const;

  struct Nearest {
    Index face;
    float distance;  // m
  };
  /// Returns the face that is nearest to a point; the first one if several are equally near. Precondition: the surface
  /// has a face, and all vertices are finite.
  Nearest nearest_face(const glm::vec3& point) const;

 private:
  glm::vec3 corner(Index face, std::size_t k) const { return at_[surface_.triangles()[face][k]]; }

  const Surface& surface_;
  VertexRun at_;
  BoxTree faces_;
};

}  // namespace collide::surface
