#pragma once
// Rigid part of the motion of particles of equal mass.

#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "softbody/state/kernel_types.h"

namespace softbody {

struct RigidMotion {
  glm::dvec3 centre{0.0}, velocity{0.0};
  glm::dvec3 momentum{0.0};  // angular, about the centre, for particles of mass 1
  glm::dmat3 inertia{0.0};   // likewise
  bool can_rotate = false;   // false for a line or a point, which has no defined spin
  glm::dvec3 spin{0.0};      // rad/s

  /// Sets whether it can rotate, and the spin, from momentum and inertia.
  void set_spin() {
    can_rotate = glm::determinant(inertia) > 1e-12 * inertia[0][0] * inertia[1][1] * inertia[2][2];
    spin = spin_of(momentum);
  }
  glm::dvec3 spin_of(const glm::dvec3& angular) const {
    return can_rotate ? glm::inverse(inertia) * angular : glm::dvec3(0.0);
  }
  /// Returns nearly spin_of(angular), but reduces the spin about an axis to which all particles are close: there, small
  /// oscillations would look like a fast spin.
  glm::dvec3 steady_spin_of(const glm::dvec3& angular) const {
    constexpr double least = 0.01;  // of the moments' sum
    const double floor = least * (inertia[0][0] + inertia[1][1] + inertia[2][2]);
    if (!(floor > 0)) return glm::dvec3(0.0);
    return glm::inverse(inertia * inertia + glm::dmat3(floor * floor)) * (inertia * angular);
  }
};

/// Returns the rotation about the direction of `turn` by its length in rad. It halves and doubles the angle instead of
/// calling sin(), whose last digits differ between processors: the quaternion (1, half) has an angle that is too small
/// by its cube over twelve.
inline glm::dmat3 rotation(const glm::dvec3& turn) {
  constexpr int doublings = 8;
  const glm::dvec3 half = turn / double(2 << doublings);
  double w = 1 / std::sqrt(1 + glm::dot(half, half));
  glm::dvec3 u = w * half;
  for (int i = 0; i < doublings; ++i) {
    const double next = 1 - 2 * glm::dot(u, u);
    u *= 2 * w;
    w = next;
  }
  const glm::dmat3 cross(0, u.z, -u.y, -u.z, 0, u.x, u.y, -u.x, 0);  // u x ...
  return glm::dmat3(1) + 2.0 * (w * cross + cross * cross);
}

/// Returns points that are turned by `axes` about the origin; without a turn, the same to the bit.
inline std::vector<glm::dvec3> turned(std::vector<glm::dvec3> points, const glm::dmat3& axes) {
  if (axes != glm::dmat3(1.0))
    for (glm::dvec3& point : points) point = axes * point;
  return points;
}

/// Returns the rigid motion of `count` particles with position(i) and velocity(i).
RigidMotion rigid_motion(std::size_t count, const auto& position, const auto& velocity) {
  RigidMotion m;
  for (std::size_t i = 0; i < count; ++i) {
    m.centre += position(i) / double(count);
    m.velocity += velocity(i) / double(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 r = position(i) - m.centre;
    m.momentum += glm::cross(r, velocity(i) - m.velocity);
    m.inertia += glm::dmat3(glm::dot(r, r)) - glm::outerProduct(r, r);
  }
  m.set_spin();
  return m;
}

/// Returns that of the body in a lane, which has `count` particles. Its centre is seen from the first one.
inline RigidMotion rigid_motion(const RigidSums& sums, std::size_t lane, double count) {
  RigidMotion m;
  m.centre = sums.place[lane] / count;
  m.velocity = sums.velocity[lane] / count;
  m.momentum = sums.momentum[lane] - count * glm::cross(m.centre, m.velocity);
  const glm::dvec3 square = sums.square[lane], mixed = sums.mixed[lane];
  const glm::dmat3 products(square.x, mixed.z, mixed.y, mixed.z, square.y, mixed.x, mixed.y, mixed.x, square.z);
  const glm::dmat3 about = products - count * glm::outerProduct(m.centre, m.centre);
  m.inertia = glm::dmat3(about[0][0] + about[1][1] + about[2][2]) - about;
  m.set_spin();
  return m;
}

}  // namespace softbody
