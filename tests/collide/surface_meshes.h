#pragma once
// Meshes and scenes for the tests of surfaces.

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
/// Returns a box from lo to hi with 8 vertices and 12 faces.
SurfaceMesh box(const glm::vec3& lo, const glm::vec3& hi);
/// Returns a square sheet in the plane y = 0 around the origin that faces up, with `quads` quads along each side.
SurfaceMesh sheet(int quads, float width);
/// Returns a prism from z = 0 to 1 over the concave pentagon (0,0) (4,0) (4,4) (2,1) (0,4) in x and y. Seen along z, it
/// has a valley.
SurfaceMesh valley();
SurfaceMesh moved(SurfaceMesh mesh, const glm::vec3& by);
/// Returns the mesh rotated by an angle (radians) about an axis through the origin.
SurfaceMesh turned(SurfaceMesh mesh, const glm::vec3& axis, float angle);

double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b);
double distance_to_face(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Bodies with surfaces. Owns the positions and surfaces that the oracle only refers to.
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
