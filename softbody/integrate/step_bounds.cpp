#include "softbody/integrate/step_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "softbody/contact/keys.h"
#include "softbody/contact/law.h"
#include "softbody/forces/penalty_law.h"
#include "softbody/state/kernels.h"

namespace softbody {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// s, of substeps that are not fixed: forces are far from linear over longer ones.
constexpr double longest_step = 1.0 / 60;

}  // namespace

SubstepBound StepBounds::measure(const Integrator& integrator, double seconds) {
  double stiffness = 0, damping = 0;  // over mass, the largest of all moving bodies
  double own_step = infinite;         // s, of the body that bears the shortest, contacts damp it or not
  double lone_step = infinite;        // s, of the one that bears the shortest without contacts
  // Substeps that keep up with the fastest body near a solid; implicit steps have no bound of stability.
  double min_substeps = std::max(1.0, seconds / longest_step);
  double deformation_rate = 0;  // 1/s: a bound by the present shape tells nothing of one far from it
  const bool pairs = !penalty_.pairs.empty();
  penalty_damping_.assign(pairs ? state_.x[0].size() : 0, 0);
  for (const PenaltyPair& p : penalty_.pairs) {
    const float c = penalty_.predicted_damping(p, field(state_.x), field(state_.v), float(seconds));
    penalty_damping_[p.slot_a] += c;
    penalty_damping_[p.slot_b] += c;
  }
  for (const Batch& b : state_.batches()) {
    if (!b.any_moves()) continue;
    const BodyModel& p = *b.model;
    const ForceBound own = bound_of(b, field(state_.x, b.base), area_);
    double stiffest = own.stiffness, damper = own.damping;
    lone_step = std::min(lone_step, integrator.stable_step(stiffest, damper));
    if (pairs) {
      stiffest += PenaltyLaw<double>::stiffness_bound(p.material[contact::stiffness]) / p.particle_mass;
      float most = 0;
      for (const float *row = penalty_damping_.data() + b.base, *end = row + b.values(); row < end; row += b.width)
        most = std::max(most, *std::max_element(row, row + b.used));
      damper += double(most) / p.particle_mass;
    }
    // What is stable only by damping must not count on that of contacts, or of another body.
    own_step = std::min(own_step, integrator.stable_step(stiffest, own.damping));
    const Extent motion = state_.extent(b, state_.v, state_.v);
    if (!solids_.near(b).empty())
      min_substeps = std::max(min_substeps, motion.max_length() * seconds / (0.1 * p.radius));
    deformation_rate = std::max(deformation_rate, motion.max_diagonal() / (0.1 * p.radius));
    stiffness = std::max(stiffness, stiffest);
    damping = std::max(damping, damper);
  }
  return {std::min(own_step, integrator.stable_step(stiffness, damping)), min_substeps, deformation_rate,
          1 / lone_step};
}

int StepBounds::trusted_substeps(std::span<const Batch* const> moving, double h) const {
  constexpr double most = 16;
  double trusted = most;
  for (const Batch* b : moving) {
    const double radius = b->model->radius, pressed = std::max(0.25 * double(penalty_.thickness), 0.05 * radius);
    const double way = penalty_.pairs.empty() ? 0.2 * radius : std::min(pressed, 0.2 * radius);
    trusted = std::min(trusted, way / (state_.max_particle_speed(*b) * h));
  }
  return static_cast<int>(trusted);
}

double StepBounds::rounding_velocity(std::span<const Batch* const> moving, double stable_step) const {
  constexpr double rounding = 1.0 / (1 << 24);
  double farthest = 0;
  for (const Batch* b : moving) {
    const Extent e = state_.extent(*b, state_.x, state_.v);
    for (int l = 0; l < b->used; ++l)
      for (const LaneVector* corner : {&e.lo, &e.hi})
        farthest = std::max(
            {farthest, double(std::abs(corner->x[l])), double(std::abs(corner->y[l])), double(std::abs(corner->z[l]))});
  }
  return rounding * farthest * 1.6 / stable_step;  // the bound is 0.8 (2 / omega), or less
}

double substeps_at_start(const BodyModel& p, const Integrator& integrator, double frame_time, float thickness,
                         double max_friction) {
  const PenaltyLaw<double> contacts{p.material[contact::stiffness], double(thickness),
                                    law::common_friction(p.material[contact::friction], max_friction)};
  const double k = stiffness_per_mass(p, measure_surface(p, p.start)) +
                   contacts.stiffness_bound(contacts.stiffness) / p.particle_mass;
  const double own = damping_bound(p), all = own + contacts.damping_bound();
  const auto stable_step = integrator.stable_step;
  return frame_time / std::min(stable_step(k, own / p.particle_mass), stable_step(k, all / p.particle_mass));
}

}  // namespace softbody
