#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "softbody/integrate/implicit/attempts.h"
#include "softbody/integrate/implicit/planes.h"

namespace softbody {
namespace {

/// Moves the body in a lane with a share of its spin, rotated by as large a share of h * turning. Returns how much
/// energy it gains by that, over the energy of this spin; 0 if it gains none.
double move_rigidly(const ImplicitStep& step, ImplicitWork& work, std::size_t lane, const glm::dvec3& turning,
                    double share) {
  constexpr double rounding = 1e-9;
  const double h = step.h;
  const std::size_t particles = step.model.mesh.vertices.size();
  const LaneView x{work.x, lane}, v{work.v, lane};
  const RigidMotion& m = step.frames.start(lane);
  const glm::dmat3 turned = rotation(share * h * turning);
  const glm::dvec3 spin = share * (turned * m.spin_of(glm::transpose(turned) * m.momentum));
  const auto aside = [&](std::size_t i) { return turned * (x(i) - m.centre) - (x(i) - m.centre); };
  const glm::dvec3 shift = stop_at(work.planes, lane, h, h * (m.velocity + h * step.gravity), aside);
  // Sums of squared speeds.
  double gain = -2 * glm::dot(step.gravity, shift) * double(particles), before = 0, spinning = 0;
  for (std::size_t i = 0; i < particles; ++i) {
    const glm::dvec3 round = glm::cross(spin, turned * (x(i) - m.centre)), velocity = shift / h + round;
    gain += glm::dot(velocity, velocity);
    before += glm::dot(v(i), v(i));
    spinning += glm::dot(round, round);
    write(work.end_x, i * lanes + lane, x(i) + aside(i) + shift);
    write(work.end_v, i * lanes + lane, velocity);
  }
  return gain - before <= rounding * before ? 0 : (gain - before) / spinning;
}

void move_without_gain(const ImplicitStep& step, ImplicitWork& work, std::size_t lane) {
  const RigidMotion& m = step.frames.start(lane);
  if (move_rigidly(step, work, lane, m.spin, 1) <= 0) return;
  // A body that spins fast about its long axis has far more energy where its spin takes it, at the same momentum. About
  // that momentum itself it can turn without gaining any.
  const double length = glm::length(m.momentum);
  const glm::dvec3 along = length > 0 ? m.momentum / length : glm::dvec3(0.0);
  const glm::dvec3 about = glm::dot(m.steady_spin_of(m.momentum), along) * along;
  const double excess = move_rigidly(step, work, lane, about, 1);
  if (excess <= 0 || (excess < 1 && move_rigidly(step, work, lane, about, std::sqrt(1 - excess)) <= 0)) return;
  move_rigidly(step, work, lane, about, 0);
}

}  // namespace

LaneMask rigid_fallback_step(const ImplicitStep& step, ImplicitWork& work, LaneMask tried) {
  for (std::size_t l = 0; l < lanes; ++l)
    if (tried[l]) move_without_gain(step, work, l);
  for (PlaneContact& c : work.planes)
    if (tried[c.at % lanes]) c.force = glm::dvec3(0.0);
  return tried;
}

}  // namespace softbody
