#include "softbody/integrate/step_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "softbody/contact/keys.h"
#include "softbody/contact/law.h"
#include "softbody/forces/kernels.h"
#include "softbody/state/kernels.h"

namespace softbody {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// s, of substeps that are not fixed: forces are far from linear over longer ones.
constexpr double longest_step = 1.0 / 60;

}  // namespace

/// Returns the largest stiffness over mass (1/s^2) of the bodies in a batch, contacts apart.
double StepBounds::stiffness_per_mass(const Batch& b) {
  const BodyModel& p = *b.model;
  double stiffest = softbody::stiffness_per_mass(p, {});
  if (!p.has_gas) return stiffest;
  for (auto& component : area_) component.resize(b.values());
  const ForceKernels& kernels = force_kernels(b.width);
  const KernelMesh& mesh = meshes_(b);
  const auto used = std::size_t(b.used);
  const Field<const float> x = field(state_.x, b.base);
  float volume[lanes], area2[lanes], stretch[lanes]{}, two_medians[lanes], one[lanes];
  std::fill(std::begin(one), std::end(one), 1.0f);
  state_kernels(b.width).clear(used, b.particles(), field(area_));
  kernels.volume(used, mesh.faces, x, volume);
  kernels.medians(used, mesh.faces, x, two_medians);
  kernels.pressure(used, mesh.faces, x, one, field(area_));
  state_kernels(b.width).square_sum(used, b.particles(), field(area_), area2);
  for (const KernelSprings* list : {&mesh.structural, &mesh.bend, &mesh.shear})
    kernels.stretch(used, *list, field(area_), stretch);
  for (int l = 0; l < b.used; ++l)
    stiffest = std::max(stiffest, softbody::stiffness_per_mass(p, {volume[l], area2[l], stretch[l], two_medians[l]}));
  return stiffest;
}

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
    double stiffest = stiffness_per_mass(b);
    double damper = p.spring_damping_bound;
    lone_step = std::min(lone_step, integrator.stable_step(stiffest, damper / p.particle_mass));
    if (pairs) {
      const auto k = static_cast<float>(p.material[contact::stiffness]);
      stiffest += PenaltyContact::stiffness_bound(k) / p.particle_mass;
      float most = 0;
      for (const float *own = penalty_damping_.data() + b.base, *end = own + b.values(); own < end; own += b.width)
        most = std::max(most, *std::max_element(own, own + b.used));
      damper += double(most);
    }
    // What is stable only by damping must not count on that of contacts, or of another body.
    own_step = std::min(own_step, integrator.stable_step(stiffest, p.spring_damping_bound / p.particle_mass));
    const Extent motion = state_.extent(b, state_.v, state_.v);
    if (!solids_.near(b).empty())
      min_substeps = std::max(min_substeps, motion.max_length() * seconds / (0.1 * p.radius));
    deformation_rate = std::max(deformation_rate, motion.max_diagonal() / (0.1 * p.radius));
    stiffness = std::max(stiffness, stiffest);
    damping = std::max(damping, damper / p.particle_mass);
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
  const auto contact = float(p.material[contact::stiffness]);
  const auto friction = float(law::common_friction(p.material[contact::friction], max_friction));
  const double k =
      stiffness_per_mass(p, measure_surface(p, p.start)) + PenaltyContact::stiffness_bound(contact) / p.particle_mass;
  const double own = p.spring_damping_bound, all = own + PenaltyContact::damping_bound(contact, friction, thickness);
  const auto stable_step = integrator.stable_step;
  return frame_time / std::min(stable_step(k, own / p.particle_mass), stable_step(k, all / p.particle_mass));
}

}  // namespace softbody
