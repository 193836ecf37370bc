// Dynamics: what acts once a frame on a body as a whole, by its rigid motion.

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "softbody/integrate/dynamics.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {
namespace {

glm::dvec3 read(const DoubleLaneVector& v, std::size_t lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }
void write(DoubleLaneVector& to, std::size_t lane, const glm::dvec3& v) {
  to.x[lane] = v.x, to.y[lane] = v.y, to.z[lane] = v.z;
}

/// Of a lane's body, but for its spin; its centre is seen from the first particle.
RigidMotion rigid_motion(const RigidSums& sums, std::size_t lane, double count) {
  RigidMotion m;
  m.centre = read(sums.place, lane) / count;
  m.velocity = read(sums.velocity, lane) / count;
  m.momentum = read(sums.momentum, lane) - count * glm::cross(m.centre, m.velocity);
  const glm::dvec3 square = read(sums.square, lane), mixed = read(sums.mixed, lane);
  const glm::dmat3 products(square.x, mixed.z, mixed.y, mixed.z, square.y, mixed.x, mixed.y, mixed.x, square.z);
  const glm::dmat3 about = products - count * glm::outerProduct(m.centre, m.centre);
  m.inertia = glm::dmat3(about[0][0] + about[1][1] + about[2][2]) - about;
  return m;
}

}  // namespace

/// Of all moving bodies, at the start of a frame.
void Dynamics::note_momenta() {
  momenta_.resize(crew_.moving().size());
  for (std::size_t i = 0; i < crew_.moving().size(); ++i) {
    const Batch& b = *crew_.moving()[i];
    kernels_of(b).rigid_sums(b.particles(), at(std::as_const(x_), b), at(std::as_const(v_), b), momenta_[i]);
  }
}

/// The forces of springs and gas add up to none, nor to a torque. But those of stiff bodies are large and cancel each
/// other at every particle, where floats round them: over many substeps the momenta walk at random. Bodies that nothing
/// has touched get back the ones of note_momenta(), after `seconds` of gravity; what the integrator itself does to the
/// angular one stays.
void Dynamics::keep_momenta(double seconds) {
  const glm::dvec3 fall = has_gravity_ ? seconds * scene_.gravity : glm::dvec3(0.0);
  for (std::size_t i = 0; i < momenta_.size(); ++i) {
    Batch& b = *crew_.moving()[i];
    const auto count = double(b.particles());
    RigidSums now;
    kernels_of(b).rigid_sums(b.particles(), at(std::as_const(x_), b), at(std::as_const(v_), b), now);
    RigidChange change{};
    for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
      if (b.moves[l] <= 0 || (b.touched >> l & 1u)) continue;
      const RigidMotion before = rigid_motion(momenta_[i], l, count), after = rigid_motion(now, l, count);
      const glm::dvec3 push = before.velocity + fall - after.velocity;
      glm::dvec3 spin(0.0);
      if (integrator_->keeps_spin) spin = after.steady_spin_of(before.momentum - after.momentum);
      if (!std::isfinite(glm::dot(push, push) + glm::dot(spin, spin))) continue;
      change.acts[l] = 1;
      write(change.push, l, push);
      write(change.spin, l, spin);
      write(change.about, l, after.centre);
    }
    kernels_of(b).add_rigid(b.particles(), change, at(std::as_const(x_), b), at(v_, b));
  }
}

void Dynamics::finish_frame(double seconds) {
  for (BodyId id = 0; id < bodies_.size(); ++id) {
    if (!bodies_[id].moves()) continue;
    if (resistance_.internal || resistance_.rebound || resistance_.rolling) resist(id, seconds);
    follow(id);
  }
}

/// What resists a body's motion as a whole, found from its rigid part v + w x r:
/// internal damping relaxes the particles' velocities towards it, at the material's rate, and changes neither linear
/// nor angular momentum (Mueller et al. 2007, section 3.5); rolling resistance takes up to coefficient * radius *
/// normal impulse of the angular momentum; rebound damping is Hunt and Crossley's (1975): a contact force N that acts
/// on a body which moves along it at u becomes N (1 - u / rebound_speed), see undue_speed() for what restitution keeps.
void Dynamics::resist(BodyId id, double seconds) {
  const Prototype& p = prototype(id);
  const Material& m = p.material;
  const double rate = resistance_.internal ? m.internal_damping * seconds : 0, share = rate / (1 + rate);
  const glm::dvec3 impulse = solid_impulse(id);
  const double normal = glm::length(impulse);
  if (normal <= 0) bodies_[id].impact = 0;
  if (share <= 0 && normal <= 0) return;
  const Body& body = bodies_[id];
  const auto count = static_cast<Index>(p.mesh.vertices.size());
  const auto read = [&](const Components& c, Index i) {
    const std::size_t s = slot(body, i);
    return glm::dvec3(c[0][s], c[1][s], c[2][s]);
  };
  const RigidMotion motion = rigid_motion(
      count, [&](std::size_t i) { return read(x_, Index(i)); }, [&](std::size_t i) { return read(v_, Index(i)); });
  if (!motion.turns) return;
  const auto& [centre, velocity, momentum, inertia, turns, spin] = motion;
  glm::dvec3 lost_spin(0.0), lost_velocity(0.0);
  if (const double size = p.particle_mass * glm::length(momentum); resistance_.rolling && p.mesh.closed && size > 0)
    lost_spin = spin * std::min(1.0, m.rolling_resistance * p.radius * normal / size);
  if (resistance_.rebound && m.rebound_speed > 0 && normal > 0) {
    const glm::dvec3 n = impulse / normal;
    lost_velocity =
        n * undue_speed(id, glm::dot(velocity, n), normal) * std::min(1.0, normal / (m.mass * m.rebound_speed));
  }
  for (Index i = 0; i < count; ++i) {
    const glm::dvec3 r = read(x_, i) - centre, v = read(v_, i);
    const glm::dvec3 damped =
        v + share * (velocity + glm::cross(spin, r) - v) - lost_velocity - glm::cross(lost_spin, r);
    for (int k = 0; k < 3; ++k) v_[std::size_t(k)][slot(body, i)] = float(damped[k]);
  }
}

/// The part of `out`, a body's speed away from the solids that gave it `impulse` in this frame, that rebound damping
/// acts on: all of it without restitution; else what is beyond the restitution times the speed of the impact.
double Dynamics::undue_speed(BodyId id, double out, double impulse) {
  Body& body = bodies_[id];
  const double in = impulse / prototype(id).material.mass - out;  // before the impulse, towards the solids
  const double restitution = std::min(1.0, double(batches_[body.batch].returned[std::size_t(body.lane)]) / impulse);
  if (in > impact_speed)
    body.impact = std::max(body.impact, in);
  else if (out < impact_speed)
    body.impact = 0;  // it is over
  return out < 0 ? (1 - restitution) * out : std::max(0.0, out - restitution * body.impact);
}

/// Moves the body's origin when its first particle, which begins no further than the radius from it, has gone further
/// than one and a half, by a multiple of 1/64 m that floats of that size hold without loss. What is rounded off further
/// out would keep stiff bodies trembling.
void Dynamics::follow(BodyId id) {
  Body& body = bodies_[id];
  const std::size_t first = slot(body, 0);
  const glm::dvec3 away(x_[0][first], x_[1][first], x_[2][first]);
  if (glm::length(away) <= 1.5 * prototype(id).radius) return;
  for (int k = 0; k < 3; ++k) {
    const double shift = std::round(away[k] * 64) / 64;
    body.origin[k] += shift;
    for (Index i = 0; i < prototype(id).mesh.vertices.size(); ++i) x_[std::size_t(k)][slot(body, i)] -= float(shift);
  }
}

}  // namespace softbody
