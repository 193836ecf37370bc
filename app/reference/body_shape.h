#pragma once
// Measures of one body's shape and motion, in double. Bodies have at least one particle.

#include <glm/vec3.hpp>

#include "app/reference/reference_body.h"

namespace app::reference {

/// Returns the root mean square distance of the particles (m). Precondition: `a` and `b` have the same size, not 0.
double rms_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b);
/// Returns by how much two shapes differ: the same distance, after `b` is moved and turned to fit `a` best.
double shape_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b);

/// Returns the signed volume (m^3) of a closed body, accurate anywhere in space.
double volume_of(const std::vector<glm::dvec3>& x, const std::vector<softbody::Triangle>& triangles);

/// The motion of a body as a whole; each particle has mass 1.
struct RigidMotion {
  glm::dvec3 centre{0.0}, velocity{0.0};  // m, m/s
  glm::dvec3 momentum{0.0};               // m^2/s, angular momentum about the centre, per particle
  glm::dvec3 spin{0.0};                   // rad/s; 0 for a body without inertia about some axis
};
RigidMotion rigid_motion(const BodyState& state);
/// Returns the root mean square (m/s) of the velocities relative to the rigid motion.
double deformation_speed(const BodyState& state);

}  // namespace app::reference
