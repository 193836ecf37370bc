#pragma once
// One scene, run to its end by one integrator and compared with a reference.

#include "app/base/timings.h"
#include "app/reference/reference_trajectory.h"
#include "app/report/solver/results.h"
#include "app/report/solver/scenes.h"

namespace app::report {

struct Outcome {
  TimedParts timed{};  // the steps
  bool finite = true;
  std::vector<reference::BodyState> bodies{};
  double energy = 0;  // J
  double taken = 0;   // substeps per frame, on average
};

/// Runs `copies` of the scene side by side, with `substeps` a frame, or with those that the integrator chooses itself
/// if it is `auto` or `substeps` is 0. Ends with the first frame that is not finite.
Outcome run_solver(const SolverScene& scene, const SolverRun& run, const softbody::Integrator& integrator, int substeps,
                   int copies);

/// Returns the point without its substeps and times.
WorkPoint judge(const SolverCase& of, const Outcome& outcome);

/// Returns the case with a curve for each integrator, that has no points yet: only the runs of own_step_integrators.
/// The reference is ReferenceBody where it models the scene, else the world's rk4. Its step is halved until the
/// positions change by less than `bound` (R), with at most `steps` steps.
SolverCase begin_case(const SolverScene& scene, const SolverRun& run, double bound, std::uint64_t steps);

}  // namespace app::report
