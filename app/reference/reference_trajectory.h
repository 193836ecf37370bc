#pragma once
// Integrates the reference body, with a step that is shown to be small enough.

#include <random>

#include "app/reference/body_shape.h"

namespace app::reference {

struct Trajectory {
  BodyState end{};
  std::uint64_t steps = 0;
  bool complete = true;  // false: it would have taken more steps than allowed
};

struct TrajectoryLimits {
  double seconds = 0.5;
  std::uint64_t steps = 200'000;
  /// m/s: a body whose unsettled_speed() stays below this for a while has settled: integrate() ends then. 0: never.
  double settled_speed = 0;
};

/// Returns the RMS speed (m/s) that shows that the body is not yet at rest. A body free of gravity and solids may move
/// and turn as a whole. For any other body all motion counts, so that one between two bounces is not at rest.
double unsettled_speed(const ReferenceBody& body, const BodyState& state);

/// Integrates with `fraction` (> 0) of the stable step, or of the step in which a particle moves a tenth of the radius
/// if that is shorter. Both steps are computed anew every few steps.
Trajectory integrate(const ReferenceBody& body, BodyState start, double fraction, const TrajectoryLimits& limits);

/// Returns a vector whose coordinates are between -1 and 1, the same ones with every compiler and library.
glm::dvec3 random_vector(std::mt19937& random);

/// Moves each position by up to `size` (m) along each axis, by fixed random numbers.
BodyState perturbed(BodyState state, double size);

struct Reference {
  BodyState end{};
  double step = 0;         // s, mean
  double change = 0;       // R, RMS of the positions when the step was last halved
  bool converged = false;  // change is within the bound
  double growth = 0;       // factor by which a perturbation of all positions by 1e-8 R has grown, RMS
};

/// Halves the step until the end changes by at most `bound` (in R), or the limits are reached.
Reference find_reference(const ReferenceBody& body, const BodyState& start, double bound,
                         const TrajectoryLimits& limits);

}  // namespace app::reference
