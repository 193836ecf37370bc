#pragma once
// A closed surface in one pose, asked about many points: what lies inside, and which face it is closest to. In float
// and double, for contact; the exact judge is surface_oracle.h.

#include "collide/core/vertex_run.h"
#include "collide/surface/box_tree.h"
#include "collide/surface/surface.h"

namespace collide::surface {

class ClosedShell {
 public:
  /// at: the vertices; they and the surface have to outlive this. Where one is not finite, nothing is inside.
  ClosedShell(const Surface& surface, const VertexRun& at);

  /// By the parity of a ray.
  bool inside(const glm::vec3& point) const;

  struct Nearest {
    Index face;
    float distance;  // m
  };
  /// The face closest to a point inside or near it, of those equally close the first. Needs finite vertices and a face.
  Nearest nearest_face(const glm::vec3& point) const;

 private:
  glm::vec3 corner(Index face, std::size_t k) const {
    const Index v = surface_.triangles()[face][k];
    return {at_.x[v], at_.y[v], at_.z[v]};
  }

  const Surface& surface_;
  VertexRun at_;
  BoxTree faces_;
};

}  // namespace collide::surface
