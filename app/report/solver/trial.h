#pragma once
// One scene, run to its end by one integrator and compared with a reference.

#include "app/base/timings.h"
#include "app/reference/reference_trajectory.h"
#include "app/report/solver/results.h"
#include "app/report/solver/scenes.h"

namespace app::report {

struct SolverRun {
  int frames = 30;
  double frame_time = 1.0 / 60;
  double seconds() const { return frames * frame_time; }
};

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

/// What outcomes are compared with.
struct SolverReference {
  std::vector<reference::BodyState> bodies;
  double energy;        // J
  double energy_scale;  // J
  std::string what;
  double step, change, growth;
  bool converged;
};
/// Halves the step until the positions change by less than `bound` (R), with at most `steps` steps. The reference is
/// ReferenceBody where it models the scene, else the world's rk4.
SolverReference find_solver_reference(const SolverScene& scene, const SolverRun& run, double bound,
                                      std::uint64_t steps);

/// Returns the scale (J) of a body's error in energy: the larger of its energy above balance and m g R.
double energy_scale(const softbody::World& world, softbody::BodyId body);

/// Returns the point without its substeps and times.
WorkPoint judge(const SolverScene& scene, const Outcome& outcome, const SolverReference& reference);

/// Returns the case with a curve for each integrator, that has no points yet: only the runs of own_step_integrators.
SolverCase begin_case(const SolverScene& scene, const SolverRun& run, const SolverReference& reference);

}  // namespace app::report
