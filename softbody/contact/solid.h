#pragma once
// Solids that bodies meet.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace softbody {

// Solids do not move. friction: Coulomb's coefficient. restitution (0 to 1): see contact/rebound.h.
struct SolidSphere {
  glm::dvec3 centre{0.0};  // m
  double radius = 1;       // m
  double friction = 0.5;
  double restitution = 0;
  bool operator==(const SolidSphere&) const = default;
};

/// Everything below an unbounded plane.
struct SolidPlane {
  glm::dvec3 point{0.0};       // m, anywhere on it
  glm::dvec3 normal{0, 1, 0};  // unit, out of the solid
  double friction = 0.5;
  double restitution = 0;
  bool operator==(const SolidPlane&) const = default;
};

struct SolidBox {
  glm::dvec3 centre{0.0};     // m
  glm::dvec3 half_size{0.5};  // m, along its own axes
  glm::dmat3 axes{1.0};       // columns: those axes in the world, orthonormal
  double friction = 0.5;
  double restitution = 0;
  bool operator==(const SolidBox&) const = default;
};

/// All points within a radius of a line segment.
struct SolidCapsule {
  glm::dvec3 from{-0.5, 0, 0}, to{0.5, 0, 0};  // m, ends of the segment
  double radius = 0.25;                        // m
  double friction = 0.5;
  double restitution = 0;
  bool operator==(const SolidCapsule&) const = default;
};

/// The plane y = height.
struct Ground {
  double height = 0;  // m
  double friction = 0.6;
  double restitution = 0;
  bool operator==(const Ground&) const = default;
};

}  // namespace softbody
