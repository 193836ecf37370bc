#pragma once
// Meshes and scenes that the surface oracle is tried on.

#include "collide/oracle/surface_oracle.h"
#include "states.h"

namespace collide::test {

using namespace collide::oracle;
using namespace collide::surface;

struct SurfaceMesh {
  std::vector<glm::vec3> vertices;
  std::vector<Triangle> triangles;
};
SurfaceMesh ball(float radius, int subdivisions = 2);
/// From lo to hi, 8 vertices and 12 faces.
SurfaceMesh box(const glm::vec3& lo, const glm::vec3& hi);
/// A sheet of quads in the plane y = 0 around the origin, facing up.
SurfaceMesh sheet(int quads, float width);
/// Prism over the concave pentagon (0,0) (4,0) (4,4) (2,1) (0,4) in x and y, from z = 0 to 1: a valley from above.
SurfaceMesh valley();
SurfaceMesh moved(SurfaceMesh mesh, const glm::vec3& by);
/// Turned by an angle about an axis through the origin, in radians.
SurfaceMesh turned(SurfaceMesh mesh, const glm::vec3& axis, float angle);

/// Bodies with surfaces; owns what the oracle only points to.
struct Scene {
  State state;
  Surfaces surfaces;

  Scene() = default;
  Scene(std::initializer_list<SurfaceMesh> meshes) {
    for (const SurfaceMesh& mesh : meshes) add(mesh);
  }
  void add(const SurfaceMesh& mesh);
  Frame frame() const { return state.frame(); }
  glm::vec3 at(Index vertex) const { return {state.x[vertex], state.y[vertex], state.z[vertex]}; }
};

Overlaps overlaps_of(const Scene& scene, int threads = 1);
SurfaceFigures figures_of(const Scene& scene);
std::vector<Crossing> crossings_of(const Scene& before, const Scene& after, int threads = 1);
SurfaceFigures figures_of(const Scene& before, const Scene& after);

}  // namespace collide::test
