#include "softbody/integrate/implicit/balance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "softbody/mechanics/deformation.h"
#include "softbody/mechanics/force_set.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {
namespace {

std::vector<glm::dvec3> shape_of(const BodyModel& model, const LaneView& x) {
  std::vector<glm::dvec3> list;
  for (std::size_t i = 0; i < model.mesh.vertices.size(); ++i) list.push_back(x(i));
  return list;
}

double kinetic_energy(const BodyModel& model, const LaneView& v) {
  double square = 0;
  for (std::size_t i = 0; i < model.mesh.vertices.size(); ++i) square += glm::dot(v(i), v(i));
  return model.particle_mass / 2 * square;
}

/// Returns the forces (N) of the table that act on the bodies from outside, in a step of h; an empty field if there
/// are none.
Lanes external_forces(const BodyModel& model, const ImplicitBodies& bodies, double h) {
  Lanes forces;
  if (!has_external_force(model)) return forces;
  forces.resize(bodies.x.size());
  const Lanes none(bodies.x.size());
  const LaneBodies<double> at_end{model, implicit_lanes, field(bodies.end_x), field(forces)};
  HeldForces held{};
  implicit_force_kernels().hold(at_end, held);
  implicit_force_kernels().add_external(at_end, held, {1 / h, field(bodies.x), field(none), 1});
  return forces;
}

/// Returns the work (J) that solids and penalty contacts may have done on the body in a step.
double contact_work(const ImplicitBodies& bodies, std::size_t lane) {
  const LaneView x{bodies.x, lane}, end_x{bodies.end_x, lane};
  double sum = 0;
  for (const PlaneContact& c : bodies.planes)  // they push out, and friction takes
    if (c.point.lane() == lane) sum += glm::dot(c.force, c.normal) * c.out();
  for (const LinearPenaltyPair& s : bodies.penalty_pairs) {
    if (s.at % implicit_lanes != lane) continue;
    const glm::dvec3 moved = end_x(s.at / implicit_lanes) - x(s.at / implicit_lanes);
    sum += std::clamp(glm::dot(s.force_after(moved), moved), 0.0, s.max_work);
  }
  return sum;
}

}  // namespace

void restore_momentum(const ImplicitStep& step, ImplicitBodies& bodies, LaneMask which) {
  const std::size_t n = step.model.mesh.vertices.size();
  const double h = step.h, mass = step.model.particle_mass;
  const Lanes external = external_forces(step.model, bodies, h);
  for (std::size_t l = 0; l < implicit_lanes; ++l) {
    if (!which[l]) continue;
    const LaneView end_x{bodies.end_x, l};
    const RigidMotion &before = step.axes.start(l), after = rigid_motion(n, end_x, LaneView{bodies.end_v, l});
    glm::dvec3 total(0.0), torque(0.0);
    for (const LinearPenaltyPair& s : bodies.penalty_pairs) {
      if (s.at % implicit_lanes != l) continue;
      const glm::dvec3 end = read(bodies.end_x, s.at), force = s.force_after(end - read(bodies.x, s.at));
      total += force;
      torque += glm::cross(end - after.centre, force);
    }
    for (std::size_t at = l; 3 * at < external.size(); at += implicit_lanes) {
      total += read(external, at);
      torque += glm::cross(read(bodies.end_x, at) - after.centre, read(external, at));
    }
    const glm::dvec3 push = before.velocity + h * (total / (mass * double(n)) + step.gravity) - after.velocity;
    const glm::dvec3 spin = after.spin_of(before.momentum + h / mass * torque - after.momentum);
    for (std::size_t i = 0; i < n; ++i)
      add(bodies.end_v, i * implicit_lanes + l, push + glm::cross(spin, end_x(i) - after.centre));
  }
}

bool satisfies_momentum_balance(const BodyModel& model, const ImplicitBodies& bodies, std::size_t lane, double h,
                                const glm::dvec3& gravity) {
  constexpr double share = 0.1;
  glm::dvec3 gained(0.0), given(0.0);
  for (std::size_t at = lane; at < bodies.x.size() / 3; at += implicit_lanes)
    gained += model.particle_mass * (read(bodies.end_v, at) - read(bodies.v, at) - h * gravity);
  for (const PlaneContact& c : bodies.planes)
    if (c.point.lane() == lane) given += h * c.force;
  for (const LinearPenaltyPair& s : bodies.penalty_pairs)
    if (s.at % implicit_lanes == lane) given += h * s.force_after(read(bodies.end_x, s.at) - read(bodies.x, s.at));
  const Lanes external = external_forces(model, bodies, h);
  for (std::size_t at = lane; 3 * at < external.size(); at += implicit_lanes) given += h * read(external, at);
  return glm::distance(gained, given) <=
         share * (glm::length(given) + h * model.material[Material::mass] * glm::length(gravity)) +
             1e-6 * model.material[Material::mass];
}

double energy_gain(const BodyModel& model, const ImplicitBodies& bodies, std::size_t lane, const glm::dvec3& gravity,
                   bool pushed) {
  constexpr double share = 5e-5, rounding = 1e-12;  // of the motion's energy, and of the springs'
  const std::size_t n = model.mesh.vertices.size();
  const LaneView x{bodies.x, lane}, v{bodies.v, lane}, end_x{bodies.end_x, lane}, end_v{bodies.end_v, lane};
  double fallen = 0;
  glm::dvec3 before_mean(0.0), after_mean(0.0);
  for (std::size_t i = 0; i < n; ++i) {
    fallen += model.particle_mass * glm::dot(gravity, end_x(i) - x(i));
    before_mean += v(i) / double(n);
    after_mean += end_v(i) / double(n);
  }
  const std::vector<glm::dvec3> start = shape_of(model, x), end = shape_of(model, end_x);
  const double before = kinetic_energy(model, v), after = kinetic_energy(model, end_v),
               elastic = elastic_energy(model, start);
  const StoredEnergy stored = stored_energy_change(model, start, end);
  const double gain = after - before - fallen - contact_work(bodies, lane) + stored.elastic + stored.gas;
  double motion = before + after;
  if (!pushed)  // then how fast it flies has no part in it
    motion -=
        model.material[Material::mass] / 2 * (glm::dot(before_mean, before_mean) + glm::dot(after_mean, after_mean));
  if (!std::isfinite(gain)) return std::numeric_limits<double>::infinity();
  return from_nowhere(gain, motion, rounding * (elastic + before), share) ? gain : 0;
}

bool dissipate(const BodyModel& model, ImplicitBodies& bodies, std::size_t lane, double energy, bool pushed) {
  constexpr double most = 0.05;  // of the energy of what is slowed
  const std::size_t n = model.mesh.vertices.size();
  if (energy <= 0) return true;
  const LaneView x{bodies.end_x, lane}, v{bodies.end_v, lane};
  const RigidMotion whole = rigid_motion(n, x, v);
  const auto kept = [&](std::size_t i) {
    return pushed ? glm::dvec3(0.0) : whole.velocity + glm::cross(whole.spin, x(i) - whole.centre);
  };
  double slowed = 0;  // J; a rigid motion and the rest of a motion have no part in each other's energy
  for (std::size_t i = 0; i < n; ++i) slowed += model.particle_mass / 2 * glm::dot(v(i) - kept(i), v(i) - kept(i));
  if (!std::isfinite(energy) || !(energy <= most * slowed)) return false;
  const double part = std::sqrt(1 - energy / slowed);
  for (std::size_t i = 0; i < n; ++i) write(bodies.end_v, i * implicit_lanes + lane, kept(i) + part * (v(i) - kept(i)));
  return true;
}

}  // namespace softbody
