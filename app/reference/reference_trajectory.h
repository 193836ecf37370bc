#pragma once
// The reference's motion at a step that is shown to be small enough.

#include "app/reference/body_shape.h"

namespace app {

struct Trajectory {
  BodyState end{};
  std::uint64_t steps = 0;
  bool complete = true;  // false: it would have taken more steps than allowed
  bool settled = false;  // it was ended early: nothing moves within the body any more
};

struct TrajectoryLimits {
  double seconds = 0.5;
  std::uint64_t steps = 200'000;
  /// m/s: a body whose unsettled_speed() is below this for a while has settled. 0: never.
  double settled_speed = 0;
};

/// m/s, RMS: what shows that the body has not come to rest. One that flies free of gravity and solids may fly on and
/// turn; of any other all motion counts, so that one between two bounces is not at rest.
double unsettled_speed(const ReferenceBody& body, const BodyState& state);

/// With `fraction` of the stable step, or of that in which some particle goes a tenth of the radius if it is shorter;
/// both are worked out anew every few steps.
Trajectory integrate(const ReferenceBody& body, BodyState start, double fraction, const TrajectoryLimits& limits);

/// Every position moved by up to `size` (m) an axis, by fixed random numbers.
BodyState perturbed(BodyState state, double size);

struct Reference {
  BodyState end{};
  double step = 0;         // s, mean
  double change = 0;       // R, RMS of the positions when the step was last halved
  bool converged = false;  // change is within the bound
  double growth = 0;       // by how much a disturbance of all positions of 1e-8 R has grown, RMS
};

/// Halves the step until the change is at most `bound` (in R), or the limits are reached.
Reference find_reference(const ReferenceBody& body, const BodyState& start, double bound,
                         const TrajectoryLimits& limits);

}  // namespace app
