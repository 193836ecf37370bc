#pragma once
// A hand: a spring with a damper that draws one point of a body's surface to a target.

#include <array>

#include <glm/vec3.hpp>

#include "softbody/shield.h"

namespace softbody {

/// The point is p = the sum of weights * corners. With the body's mass M, w = 2 pi frequency and z the damping ratio,
/// the body as a whole swings on the hand as a point would: M w^2 (target - p) - 2 z M w p'.
struct Grab {
  BodyId body = 0;
  std::array<std::uint32_t, 3> corners{};  // vertices of the body, counted from its first
  glm::dvec3 weights{1, 0, 0};             // of the corners; their sum is 1
  glm::dvec3 target{0.0};                  // m
  double frequency = 2.5;                  // Hz
  double damping_ratio = 0.7;              // of the critical damping

  bool operator==(const Grab&) const = default;
};

/// Spring and damper k, c on a particle of mass m that moves at v, pulled by `stretch` towards the target:
///
///   F = (k stretch - (c + h k) v) / (1 + h (c + h k) / m),
///
/// the impulse over a step of h seconds by implicit Euler, as in a soft constraint (Catto 2011). v holds what all other
/// forces do in the step. It acts as a mass of h (c + h k) more would, so that no k and c is too stiff for any step of
/// any integrator, and where the other forces are in balance with k * stretch it gives just that. In N; lengths in m.
inline glm::dvec3 pull(double k, double c, double m, double h, const glm::dvec3& stretch, const glm::dvec3& v) {
  const double damping = c + h * k;
  return (k * stretch - damping * v) / (1 + h * damping / m);
}

}  // namespace softbody
