#pragma once
// Cores of solids, which can meet faces and edges of a body between its vertices: corners and edges of boxes, centres
// of spheres, and axes of capsules.

#include <array>
#include <cstdint>
#include <vector>

#include "softbody/contact/solid.h"

namespace softbody {

/// A point, which meets faces, or a line segment, which meets edges.
struct SolidCore {
  glm::dvec3 from, to;  // m, world; the same for a point
  glm::dvec3 out{0.0};  // of a box: the sum of the outward normals of its sides that meet there
  bool point() const { return from == to; }
};
/// Returns the cores of a solid; its surface is core_radius() away from them. A plane has none: if no vertex passes it,
/// nothing does.
std::vector<SolidCore> cores_of(const SolidSphere& sphere);
std::vector<SolidCore> cores_of(const SolidPlane& plane);
std::vector<SolidCore> cores_of(const SolidBox& box);
std::vector<SolidCore> cores_of(const SolidCapsule& capsule);
inline double core_radius(const SolidSphere& sphere) { return sphere.radius; }
inline double core_radius(const SolidPlane&) { return 0; }
inline double core_radius(const SolidBox&) { return 0; }
inline double core_radius(const SolidCapsule& capsule) { return capsule.radius; }
/// How close a body may come to the cores in a frame.
struct Approach {
  double distance;               // m, from the cores to where the body is kept
  double speed;                  // m/s, with which it may come
  double travel;                 // m, that it may go
  std::array<glm::vec3, 2> box;  // m, its two ends, from the body's origin
};

/// A face or edge of a body that may meet a core in the coming frame.
struct SolidFeature {
  int lane;                               // of the body in its batch
  std::size_t solid;                      // among those near the batch
  std::array<std::uint32_t, 3> vertices;  // an edge's last one is no_vertex
  glm::vec3 from, to, out;                // the core, from the body's origin
  float distance;                         // m, from it to where the body is kept
  float speed;                            // m/s, with which the body may come
  float free_travel = 0;                  // m, that it may go at least before the two can meet
  static constexpr std::uint32_t no_vertex = ~std::uint32_t{0};
};

}  // namespace softbody
