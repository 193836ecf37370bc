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

StepBound StepBounds::measure(const Integrator& integrator) const {
  const std::vector<const Batch*>& moving = shares_.moving();
  std::vector<StepBound> bounds(moving.size());
  shares_.for_each(moving.size(), [&](std::size_t i) { bounds[i] = measure(*moving[i], integrator); });
  StepBound most;
  for (const StepBound& b : bounds)
    for (const auto member : {&StepBound::stable, &StepBound::breathing, &StepBound::deformation, &StepBound::passing,
                              &StepBound::fastest, &StepBound::volume_change})
      most.*member = std::max(most.*member, b.*member);
  return most;
}

StepBound StepBounds::measure(const Batch& b, const Integrator& integrator) const {
  const BodyModel& model = *b.model;
  const ForceBound force = bound_of(b, field(state_.x, b.base), integrator.projects);
  const double contact =
      penalty_.pairs().empty()
          ? 0
          : PenaltyLaw<double>::stiffness_bound(model.material[contact::stiffness]) / model.particle_mass;
  // What XPBD does not project acts as in semi-implicit Euler.
  const auto step = integrator.projects ? stable_step : integrator.stable_step;
  const auto rate = [&](double stiffness) { return 1 / step(stiffness + contact, force.damping); };
  unsigned near = 0;  // bits: lanes
  for (const SolidArguments& solid : solids_.near(b)) near |= solid.near;
  const Extent motion = state_.extent(b, state_.v, state_.v);
  const double pace = 0.1 * model.radius;
  return {(1 - gas_reserve) / (1 - gasless_reserve) * rate(force.implicit_volume),
          rate(force.stiffness),
          max_of_moving(b, [&](std::size_t l) { return motion.diagonal(l); }) / pace,
          max_of_moving(b, [&](std::size_t l) { return near >> l & 1u ? motion.length(l) : 0; }) / pace,
          StepBounds::pace(b, motion),
          force.volume_change};
}

double StepBounds::pace(const Batch& b, const Extent& motion) {
  return max_of_moving(b, [&](std::size_t l) { return motion.length(l); }) / b.model->radius;
}

double StepBounds::fastest() const {
  const std::vector<const Batch*>& moving = shares_.moving();
  std::vector<double> paces(moving.size());
  shares_.for_each(moving.size(),
                   [&](std::size_t i) { paces[i] = pace(*moving[i], state_.extent(*moving[i], state_.v, state_.v)); });
  return paces.empty() ? 0 : *std::ranges::max_element(paces);
}

int StepBounds::substeps_in_shape(double fastest, double h) { return int(std::min(16.0, 0.2 / (fastest * h))); }

double StepBounds::rounding(std::span<const Batch* const> batches, std::span<const Extent> extents) {
  constexpr double rounding = 1.0 / (1 << 24);
  double farthest = 0;
  for (std::size_t i = 0; i < batches.size(); ++i)
    farthest =
        std::max(farthest, max_of_moving(*batches[i], [&](std::size_t l) { return max_coordinate(extents[i], l); }));
  return rounding * farthest;
}

}  // namespace softbody
