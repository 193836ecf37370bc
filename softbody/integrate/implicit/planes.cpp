#include "softbody/integrate/implicit/planes.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "softbody/state/rigid_motion.h"

namespace softbody {

namespace {

/// m, by which a particle's end is short of what its plane needs.
double missing(const ImplicitWork& work, const PlaneContact& c) {
  return c.min_displacement - glm::dot(read(work.end_x, c.at) - read(work.x, c.at), c.normal);
}

}  // namespace

std::array<bool, implicit_lanes> behind_planes(const ImplicitWork& work) {
  std::array<bool, implicit_lanes> behind{};
  for (const PlaneContact& c : work.planes)
    behind[c.at % implicit_lanes] = behind[c.at % implicit_lanes] || missing(work, c) > 0;
  return behind;
}

void clear_planes(ImplicitWork& work, double h) {
  bool any = true;
  for (int pass = 0; any && pass < plane_passes; ++pass) {
    any = false;
    for (const PlaneContact& c : work.planes) {
      const double by = missing(work, c);
      if (!(by > 0)) continue;
      any = true;
      add(work.end_x, c.at, by * c.normal);
      add(work.end_v, c.at, by / h * c.normal);
    }
  }
}

bool satisfies_momentum_balance(const BodyModel& p, const ImplicitWork& work, std::size_t lane, double h,
                                const glm::dvec3& gravity) {
  constexpr double share = 0.1;
  glm::dvec3 gained(0.0), given(0.0);
  for (std::size_t at = lane; at < work.x.size() / 3; at += implicit_lanes)
    gained += p.particle_mass * (read(work.end_v, at) - read(work.v, at) - h * gravity);
  for (const PlaneContact& c : work.planes)
    if (c.at % implicit_lanes == lane) given += h * c.force;
  for (const LinearPenaltyPair& s : work.penalty_pairs)
    if (s.at % implicit_lanes == lane) given += h * s.force_after(read(work.end_x, s.at) - read(work.x, s.at));
  return glm::distance(gained, given) <=
         share * (glm::length(given) + h * p.material.mass * glm::length(gravity)) + 1e-6 * p.material.mass;
}

void rigid_fallback_step(ImplicitWork& work, std::size_t lane, double h, const glm::dvec3& gravity) {
  const std::size_t particles = work.x.size() / (3 * implicit_lanes);
  const LaneView x{work.x, lane}, v{work.v, lane};
  const RigidMotion m = rigid_motion(particles, x, v);
  // With a share of its spin, turning as fast: by how much of that spin's energy the body would have more.
  const auto move = [&](const glm::dvec3& turning, double share) {
    const glm::dmat3 turned = rotation(share * h * turning);
    const glm::dvec3 spin = share * (turned * m.spin_of(glm::transpose(turned) * m.momentum));
    const auto aside = [&](std::size_t i) { return turned * (x(i) - m.centre) - (x(i) - m.centre); };
    const glm::dvec3 shift = stop_at(work.planes, lane, h, h * (m.velocity + h * gravity), aside);
    double gain = -2 * glm::dot(gravity, shift) * double(particles), before = 0, spinning = 0;
    for (std::size_t i = 0; i < particles; ++i) {
      const glm::dvec3 place = x(i) + aside(i) + shift, round = glm::cross(spin, turned * (x(i) - m.centre)),
                       velocity = shift / h + round;
      gain += glm::dot(velocity, velocity);
      before += glm::dot(v(i), v(i));
      spinning += glm::dot(round, round);
      write(work.end_x, i * implicit_lanes + lane, place);
      write(work.end_v, i * implicit_lanes + lane, velocity);
    }
    constexpr double rounding = 1e-9;
    return gain - before <= rounding * before ? 0 : (gain - before) / spinning;
  };
  if (move(m.spin, 1) > 0) {
    // Turned by its spin, one that spins fast about its long axis comes to where its momentum is far more energy. About
    // that momentum itself it can turn without gaining any.
    const double length = glm::length(m.momentum);
    const glm::dvec3 along = length > 0 ? m.momentum / length : glm::dvec3(0.0);
    const glm::dvec3 about = glm::dot(m.steady_spin_of(m.momentum), along) * along;
    if (const double excess = move(about, 1); excess > 0 && !(excess < 1 && move(about, std::sqrt(1 - excess)) <= 0))
      move(about, 0);
  }
  for (PlaneContact& c : work.planes)
    if (c.at % implicit_lanes == lane) c.force = glm::dvec3(0.0);
}

}  // namespace softbody
