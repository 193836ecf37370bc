#pragma once
// Numbers of one body's shape and motion, in double.

#include <glm/vec3.hpp>

#include "app/reference/reference_body.h"

namespace app {

/// m, root of the mean square over the particles.
double rms_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b);
/// The same once `b` has been moved and turned to where it fits `a` best: how much their shapes differ.
double shape_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b);

/// m^3, signed, of a closed body wherever it is.
double volume_of(const std::vector<glm::dvec3>& x, const std::vector<softbody::Triangle>& triangles);

/// A body's motion as a whole, particles of mass 1.
struct RigidMotion {
  glm::dvec3 centre{0.0}, velocity{0.0};  // m, m/s
  glm::dvec3 momentum{0.0};               // m^2/s a particle: angular, about the centre
  glm::dvec3 spin{0.0};                   // 1/s; 0 for what has no inertia about some axis
};
RigidMotion rigid_motion(const BodyState& state);
/// m/s, root of the mean square of what velocities differ from the rigid motion by.
double deformation_speed(const BodyState& state);

}  // namespace app
