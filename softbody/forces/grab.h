#pragma once
// A hand: a damped spring that pulls one point of a body's surface to a target.

#include <array>

#include <glm/vec3.hpp>

#include "softbody/state/body.h"

namespace softbody {

/// The point is p = the sum of weights * corners. The force on it is M w^2 (target - p) - 2 z M w p' with the body's
/// mass M, w = 2 pi frequency and the damping ratio z: the body as a whole swings on the hand as a point mass would.
struct Grab {
  BodyId body = 0;
  std::array<std::uint32_t, 3> corners{};  // vertices of the body, counted from its first
  glm::dvec3 weights{1, 0, 0};             // of the corners; their sum is 1
  glm::dvec3 target{0.0};                  // m
  double frequency = 2.5;                  // Hz
  double damping_ratio = 0.7;              // of the critical damping

  bool operator==(const Grab&) const = default;
};

/// Returns the force (N) of a spring k and a damper c on a particle of mass m and velocity v, `stretch` (m) away from
/// the target:
///
///   F = (k stretch - (c + h k) v) / (1 + h (c + h k) / m).
///
/// It is the impulse of an implicit Euler step of h seconds, over h, as in a soft constraint (Catto 2011). v includes
/// what all other forces do in the step. The force acts like an additional mass of h (c + h k), so that no k and c are
/// too stiff for any step of any integrator. If the other forces balance k * stretch, it is k * stretch.
inline glm::dvec3 pull(double k, double c, double m, double h, const glm::dvec3& stretch, const glm::dvec3& v) {
  const double damping = c + h * k;
  return (k * stretch - damping * v) / (1 + h * damping / m);
}

}  // namespace softbody
