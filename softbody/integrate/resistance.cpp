#include "softbody/integrate/resistance.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

#include "softbody/contact/keys.h"
#include "softbody/contact/law.h"
#include "softbody/contact/solid_law.h"
#include "softbody/integrate/plan.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {
namespace {

/// The part of `out`, a body's speed away from the solids that gave it the impulse in this frame, that rebound damping
/// acts on: all of it without restitution; else what is beyond the restitution times the speed of the impact.
double excess_rebound_speed(double out, double impulse, double returned, double mass, double& impact) {
  const double in = impulse / mass - out;  // before the impulse, towards the solids
  const double restitution = std::min(1.0, returned / impulse);
  if (in > law::impact_speed)
    impact = std::max(impact, in);
  else if (out < law::impact_speed)
    impact = 0;  // it is over
  return out < 0 ? (1 - restitution) * out : std::max(0.0, out - restitution * impact);
}

}  // namespace

void Resistance::set_plan(const Plan& plan) {
  internal_ = plan.has(Stage::internal_damping);
  rebound_ = plan.has(Stage::rebound_damping);
  rolling_ = plan.has(Stage::rolling_resistance);
}

void Resistance::apply(const BodyModel& p, const BodyField& x, const BodyField& v, const SolidPush& push,
                       double seconds, double& impact) const {
  assert(seconds >= 0);
  if (!internal_ && !rebound_ && !rolling_) return;
  const Material& m = p.material;
  const double rate = internal_ ? m[Material::internal_damping] * seconds : 0, share = rate / (1 + rate);
  const double normal = glm::length(push.impulse);
  if (normal <= 0) impact = 0;
  if (share <= 0 && normal <= 0) return;
  const std::size_t count = p.mesh.vertices.size();
  const RigidMotion motion = rigid_motion(count, x, v);
  if (!motion.can_rotate) return;
  const auto& [centre, velocity, momentum, inertia, can_rotate, spin] = motion;
  glm::dvec3 lost_spin(0.0), lost_velocity(0.0);
  if (const double size = p.particle_mass * glm::length(momentum); rolling_ && p.rolls && size > 0)
    lost_spin = spin * std::min(1.0, m[contact::rolling_resistance] * p.radius * normal / size);
  if (rebound_ && m[contact::rebound_speed] > 0 && normal > 0) {
    const glm::dvec3 n = push.impulse / normal;
    lost_velocity = n * excess_rebound_speed(glm::dot(velocity, n), normal, push.returned, m[Material::mass], impact) *
                    std::min(1.0, law::damper(normal, m[contact::rebound_speed]) / m[Material::mass]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 r = x(i) - centre, old = v(i);
    v.set(i, old + share * (velocity + glm::cross(spin, r) - old) - lost_velocity - glm::cross(lost_spin, r));
  }
}

}  // namespace softbody
