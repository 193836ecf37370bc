#include "softbody/integrate/implicit/momentum.h"

#include <glm/geometric.hpp>

#include "softbody/state/rigid_motion.h"

namespace softbody {

void restore_momentum(const ImplicitStep& step, ImplicitWork& work, LaneMask which) {
  const std::size_t n = step.model.mesh.vertices.size();
  const double h = step.h, mass = step.model.particle_mass;
  for (std::size_t l = 0; l < lanes; ++l) {
    if (!which[l]) continue;
    const LaneView end_x{work.end_x, l};
    const RigidMotion &before = step.frames.start(l), after = rigid_motion(n, end_x, LaneView{work.end_v, l});
    glm::dvec3 total(0.0), torque(0.0);
    for (const LinearPenaltyPair& s : work.penalty_pairs) {
      if (s.at % lanes != l) continue;
      const glm::dvec3 end = read(work.end_x, s.at), force = s.force_after(end - read(work.x, s.at));
      total += force;
      torque += glm::cross(end - after.centre, force);
    }
    const glm::dvec3 push = before.velocity + h * (total / (mass * double(n)) + step.gravity) - after.velocity;
    const glm::dvec3 spin = after.spin_of(before.momentum + h / mass * torque - after.momentum);
    for (std::size_t i = 0; i < n; ++i)
      add(work.end_v, i * lanes + l, push + glm::cross(spin, end_x(i) - after.centre));
  }
}

bool satisfies_momentum_balance(const BodyModel& p, const ImplicitWork& work, std::size_t lane, double h,
                                const glm::dvec3& gravity) {
  constexpr double share = 0.1;
  glm::dvec3 gained(0.0), given(0.0);
  for (std::size_t at = lane; at < work.x.size() / 3; at += lanes)
    gained += p.particle_mass * (read(work.end_v, at) - read(work.v, at) - h * gravity);
  for (const PlaneContact& c : work.planes)
    if (c.at % lanes == lane) given += h * c.force;
  for (const LinearPenaltyPair& s : work.penalty_pairs)
    if (s.at % lanes == lane) given += h * s.force_after(read(work.end_x, s.at) - read(work.x, s.at));
  return glm::distance(gained, given) <=
         share * (glm::length(given) + h * p.material[Material::mass] * glm::length(gravity)) +
             1e-6 * p.material[Material::mass];
}

}  // namespace softbody
