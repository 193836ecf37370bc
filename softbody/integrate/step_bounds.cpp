#include "softbody/integrate/step_bounds.h"

#include <algorithm>
#include <cmath>

#include "softbody/contact/keys.h"
#include "softbody/forces/penalty_law.h"

namespace softbody {
namespace {

/// Returns the largest value of the lanes of a batch that move, at least 0.
template <class OfLane>
double max_of_moving(const Batch& b, const OfLane& of_lane) {
  double most = 0;
  for (std::size_t l = 0; l < std::size_t(b.used); ++l)
    if (b.moves[l] > 0) most = std::max(most, double(of_lane(l)));
  return most;
}

double max_coordinate(const Extent& e, std::size_t l) {
  float most = 0;
  for (const LaneVector* corner : {&e.lo, &e.hi})
    most = std::max({most, std::abs(corner->x[l]), std::abs(corner->y[l]), std::abs(corner->z[l])});
  return double(most);
}

}  // namespace

StepBound StepBounds::measure(const Integrator& integrator) {
  StepBound bound;
  for (const Batch& b : state_.batches()) {
    if (!b.any_moves()) continue;
    const BodyModel& p = *b.model;
    const ForceBound force = bound_of(b, field(state_.x, b.base), area_);
    const double contact = penalty_.pairs.empty()
                               ? 0
                               : PenaltyLaw<double>::stiffness_bound(p.material[contact::stiffness]) / p.particle_mass;
    const auto rate = [&](double stiffness) { return 1 / integrator.stable_step(stiffness + contact, force.damping); };
    unsigned near = 0;  // bits: lanes
    for (const SolidArguments& solid : solids_.near(b)) near |= solid.near;
    const Extent motion = state_.extent(b, state_.v, state_.v);
    const double pace = 0.1 * p.radius;
    bound.stable = std::max(bound.stable, rate(force.implicit_volume));
    bound.breathing = std::max(bound.breathing, rate(force.stiffness));
    bound.deformation =
        std::max(bound.deformation, max_of_moving(b, [&](std::size_t l) { return motion.diagonal(l); }) / pace);
    bound.passing = std::max(
        bound.passing, max_of_moving(b, [&](std::size_t l) { return near >> l & 1u ? motion.length(l) : 0; }) / pace);
  }
  return bound;
}

int StepBounds::trusted_substeps(double h) const {
  double trusted = 16;
  for (const Batch& b : state_.batches()) {
    if (!b.any_moves()) continue;
    const Extent motion = state_.extent(b, state_.x, state_.v);
    const double speed = max_of_moving(b, [&](std::size_t l) { return motion.length(l); });
    trusted = std::min(trusted, 0.2 * b.model->radius / (speed * h));
  }
  return static_cast<int>(trusted);
}

double StepBounds::rounding() const {
  constexpr double rounding = 1.0 / (1 << 24);
  double farthest = 0;
  for (const Batch& b : state_.batches()) {
    if (!b.any_moves()) continue;
    const Extent extent = state_.extent(b, state_.x, state_.v);
    farthest = std::max(farthest, max_of_moving(b, [&](std::size_t l) { return max_coordinate(extent, l); }));
  }
  return rounding * farthest;
}

}  // namespace softbody
