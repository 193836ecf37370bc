#pragma once
// What `report solver` measures, and its table, page and plots.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/timings.h"
#include "app/reference/reference_trajectory.h"
#include "app/report/page.h"
#include "app/report/worlds.h"
#include "softbody/integrate/integrators.h"

namespace app::report {

/// What a solver is measured on. Only springs, gas, gravity and solids act on lone bodies, so that the reference models
/// them.
struct SolverScene {
  std::string key, name;
  softbody::Scene scene{};
  std::vector<Particles> start{};  // per body; empty: as the scene has it
  bool at_rest = false;            // all motion is jitter
  bool of_centres = false;         // the error is the largest of a body's centre; else the RMS of all particles
  double promised = 0.01;          // R, the error that `auto` promises, see SolverCase::allowed()
};

/// Returns the scenes of `report solver`: easy ones, and those in which IMEX Euler is weakest.
std::vector<SolverScene> solver_scenes();

// How far a scene is simulated.
inline constexpr int solver_frames = 30;
inline constexpr double solver_frame_time = 1.0 / 60, solver_seconds = solver_frames * solver_frame_time;

/// What the outcomes of a scene are compared with: the end of a run and how far it can be trusted. Only ReferenceBody
/// fills in `end`, of the one body that it models.
struct SolverReference : reference::Reference {
  std::vector<reference::BodyState> bodies{};  // at the end
  double energy = 0, energy_scale = 0;         // J
  std::string what{};                          // it is
};

/// One integrator with one number of steps per frame.
struct WorkPoint {
  int substeps = 0;                           // 0: it chose them itself
  double taken = 0;                           // substeps per frame that it took, on average
  double cpu_alone = 0;                       // ms of processor time per simulated second, of a lone body
  std::optional<double> cpu_batch{};          // the same per body, of a full block
  bool blew_up = false;                       // then the rest has no meaning
  double error = 0;                           // R, at the end, see SolverScene::of_centres
  double energy = 0;                          // of the reference's, in the energy scale
  std::optional<double> linear{}, angular{};  // momentum, of the reference's; only where nothing acts from outside
  std::optional<double> volume{};             // of the reference's; only closed bodies
  double speed = 0;                           // m/s, RMS of motion within the bodies at the end: jitter where they rest
  double cost() const { return cpu_batch.value_or(cpu_alone); }
};

/// Returns "8", or "own".
inline std::string steps_text(const WorkPoint& p) { return p.substeps > 0 ? std::to_string(p.substeps) : "own"; }

struct WorkCurve {
  const softbody::Integrator* integrator;
  std::vector<WorkPoint> points{};   // by substeps
  std::optional<WorkPoint> own{};    // with the steps that it chooses itself, untimed; see own_step_integrators
  bool reaches(double error) const;  // R
};

/// Integrators that are also run with the steps that they choose themselves: `auto`, and those that its promise is
/// about.
inline constexpr std::array<std::string_view, 3> own_step_integrators{"auto", "imex-euler", "semi-implicit-euler"};

struct SolverCase {
  SolverScene scene;
  SolverReference reference;
  std::vector<WorkCurve> curves{};
  /// Returns the run of one of own_step_integrators with the steps that it chose itself.
  const WorkPoint& own(std::string_view integrator) const;
  /// Returns the error (R) that `auto` promises not to exceed: the scene's, or twice that of semi-implicit Euler with
  /// its own steps.
  double allowed() const;
  bool keeps_promise() const { return !own("auto").blew_up && own("auto").error <= allowed(); }
  /// Returns the uncertainty (R) of the reference if its change is to be within `bound`. Smaller errors say nothing. A
  /// curve ends with the first of them.
  double uncertainty(double bound) const { return std::max(bound, reference.change); }
  static constexpr double max_order_error = 0.3;  // R: larger errors show no order
  static constexpr double clear_fall = 0.8;       // of the error before; a smaller fall may be rounding
  /// Returns the observed order of a curve's error; nothing if its errors do not show one. It is the median over the
  /// longest row of errors that clearly fall, of rows of the same length over the one with the most steps. Other errors
  /// are rounding, or too coarse. A row has at least two falls, or one that reaches the uncertainty. The errors of a
  /// body that starts in balance are only rounding.
  std::optional<double> order(const WorkCurve& curve, double bound) const;
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
Outcome run_solver(const SolverScene& scene, const softbody::Integrator& integrator, int substeps, int copies);

/// Returns the point without its substeps and times.
WorkPoint judge(const SolverCase& of, const Outcome& outcome);

/// Returns the case with a curve for each integrator, that has no points yet: only the runs of own_step_integrators.
/// The reference is ReferenceBody where it models the scene, else the world's rk4. Its step is halved until the
/// positions change by less than `bound` (R), with at most `steps` steps.
SolverCase begin_case(const SolverScene& scene, double bound, std::uint64_t steps);

struct CoarseResults {
  std::size_t vertices = 0;  // of the fine mesh
  Table runs{};              // from few particles to many
};

/// Measures what a coarse mesh that is simulated in place of a fine one costs and saves: the creature of the scene
/// `shapes` at several resolutions, the finest of them the mesh itself. quick: once, with fewer.
CoarseResults measure_coarse(bool quick);

/// A body of one shape and one material.
struct Stiffness {
  std::string body;       // its shape and its forces
  std::size_t particles;  // of its mesh
  double sag;             // R: how much lower it is on the ground, at rest, than in free flight
  double period;          // s, of its slowest swing after it was stretched
};

/// Measures whether a material is as stiff in a fine mesh as in a coarse one, each body in meshes from coarse to fine.
/// quick: without the finest meshes.
std::vector<Stiffness> measure_stiffness(bool quick);

struct SolverEffort {
  double seconds = 0;                 // of processor time: a curve ends with the first run that takes longer ...
  int repetitions = 0;                // of each point; fewer if these took those seconds
  std::uint64_t reference_steps = 0;  // at most, of the reference
  int max_substeps = 1 << 14;         // ... or with this many steps per frame
  double bound = 2e-5;                // R, of the reference's change
};

struct SolverResults {
  ReportOptions options{};
  SolverEffort effort{};
  TimedParts timed{};  // the repetitions
  std::vector<SolverCase> cases{};
  CoarseResults coarse{};              // empty where a scene was asked for
  std::vector<Stiffness> stiffness{};  // empty if one scene was asked for
};

/// Returns solver.csv: a row per point. What has no meaning is empty.
Table solver_table(const SolverResults& results);
Page solver_page(const SolverResults& results);

/// Makes the report: what each integrator's error is, and what it costs.
void report_solver(const ReportOptions& options);

}  // namespace app::report
