#include "softbody/integrate/resistance.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>

#include "softbody/contact/keys.h"
#include "softbody/contact/law.h"
#include "softbody/contact/solid_law.h"
#include "softbody/integrate/plan.h"
#include "softbody/state/kernels.h"
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

void Resistance::apply(const BatchView& view, std::span<const SolidPush> pushes, double seconds,
                       std::span<double> impacts) const {
  const Batch& b = view.batch;
  assert(seconds >= 0 && pushes.size() >= std::size_t(b.used) && impacts.size() >= std::size_t(b.used));
  if (!internal_ && !rebound_ && !rolling_) return;
  const BodyModel& p = *b.model;
  const Material& m = p.material;
  const double rate = internal_ ? m[Material::internal_damping] * seconds : 0, share = rate / (1 + rate);
  unsigned acts = 0;  // bits: lanes
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
    if (b.moves[l] <= 0) continue;
    const bool touches = pushes[l].impulse != glm::dvec3(0.0);
    if (!touches) impacts[l] = 0;
    acts |= unsigned(share > 0 || touches) << l;
  }
  if (!acts) return;
  const StateKernels& kernels = state_kernels(b.width);
  const auto used = std::size_t(b.used), count = b.particles();
  RigidSums sums;
  kernels.rigid_sums(used, count, view.x, view.v, sums);
  RigidChange change{};
  for (std::size_t l = 0; l < used; ++l) {
    if (!(acts >> l & 1u)) continue;
    const RigidMotion motion = rigid_motion(sums, l, double(count));
    if (!motion.can_rotate) continue;
    const double normal = glm::length(pushes[l].impulse);
    glm::dvec3 velocity = share * motion.velocity, spin = share * motion.spin;
    if (const double size = p.particle_mass * glm::length(motion.momentum); rolling_ && p.rolls && size > 0)
      spin -= motion.spin * std::min(1.0, m[contact::rolling_resistance] * p.radius * normal / size);
    if (rebound_ && m[contact::rebound_speed] > 0 && normal > 0) {
      const glm::dvec3 n = pushes[l].impulse / normal;
      velocity -= n *
                  excess_rebound_speed(glm::dot(motion.velocity, n), normal, pushes[l].returned, m[Material::mass],
                                       impacts[l]) *
                  std::min(1.0, law::damper(normal, m[contact::rebound_speed]) / m[Material::mass]);
    }
    change.set(l, 1 - share, velocity, spin, motion.centre);
  }
  kernels.change_rigidly(used, count, change, view.x, view.v);
}

}  // namespace softbody
