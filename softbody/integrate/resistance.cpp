#include "softbody/integrate/resistance.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

#include "softbody/contact/keys.h"
#include "softbody/contact/law.h"
#include "softbody/contact/rebound.h"
#include "softbody/forces/model_forces.h"
#include "softbody/integrate/plan.h"
#include "softbody/state/kernels.h"
#include "softbody/state/rigid_motion.h"

namespace softbody {

double internal_damping(const BodyModel& model) {
  const auto* shape = data<ShapeMatching>(model);
  const double frequency = shape ? std::sqrt(shape->stiffness / model.particle_mass) : 0;  // angular
  return std::max(model.material[Material::internal_damping], 2 * ShapeMatching::damping_ratio * frequency);
}

void Resistance::set_plan(const Plan& plan) {
  internal_ = plan.has(Stage::internal_damping);
  rebound_ = plan.has(Stage::rebound_damping);
  rolling_ = plan.has(Stage::rolling_resistance);
  restitution_ = plan.has(Stage::restitution);
}

void Resistance::apply(const BatchView& view, std::span<const SolidPush> pushes, double seconds,
                       std::span<Impact> impacts) const {
  const Batch& b = view.batch;
  assert(seconds >= 0 && pushes.size() >= std::size_t(b.used) && impacts.size() >= std::size_t(b.used));
  if (!internal_ && !rebound_ && !rolling_ && !restitution_) return;
  const BodyModel& model = *b.model;
  const Material& m = model.material;
  const double rate = internal_ ? internal_damping(model) * seconds : 0, share = rate / (1 + rate);
  unsigned acts = 0;  // bits: lanes
  for (std::size_t l = 0; l < std::size_t(b.used); ++l) {
    if (b.moves[l] <= 0) continue;
    acts |= unsigned(share > 0 || pushes[l].impulse != glm::dvec3(0.0) || impacts[l].speed > 0) << l;
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
    if (const double size = model.particle_mass * glm::length(motion.momentum); rolling_ && model.rolls && size > 0)
      spin -= motion.spin * std::min(1.0, m[contact::rolling_resistance] * model.radius * normal / size);
    glm::dvec3 after = motion.velocity;
    double returned = pushes[l].returned;
    if (rebound_ && m[contact::rebound_speed] > 0 && normal > 0) {
      const glm::dvec3 n = pushes[l].impulse / normal;
      const double out = glm::dot(motion.velocity, n);
      const glm::dvec3 less =
          n * out * std::min(1.0, law::damper(normal, m[contact::rebound_speed]) / m[Material::mass]);
      velocity -= less;
      after -= less;
      returned +=
          law::bounce_energy(-m[Material::mass] * glm::dot(less, n), out, glm::dot(after, n), pushes[l].restitution);
    }
    if (restitution_)
      velocity += rebound(impacts[l], pushes[l].impulse, returned,
                          motion.velocity - pushes[l].impulse / m[Material::mass], after, m[Material::mass], seconds);
    change.set(l, 1 - share, velocity, spin, motion.centre);
  }
  kernels.change_rigidly(used, count, change, view.x, view.v);
}

}  // namespace softbody
