#include "app/base/usage_error.h"
#include "app/files/output_file.h"
#include "app/report/files.h"
#include "app/report/solver/results.h"
#include "softbody/state/lanes.h"

namespace app::report {
namespace {

/// Adds points with more and more steps to a curve, which have no cost yet but that of the run itself.
void find_errors(const SolverCase& c, WorkCurve& curve, const SolverEffort& effort) {
  const softbody::Integrator& integrator = *curve.integrator;
  double took = 0;
  const int max_steps = integrator.automatic ? 1 : effort.max_substeps;
  for (int n = 1; n <= max_steps && took < effort.seconds && !curve.reaches(c.uncertainty(effort.bound)); n *= 2) {
    const Outcome outcome = run_solver(c.scene, integrator, n, 1);
    took = outcome.finite ? outcome.timed.processor : 0;
    WorkPoint& point = curve.points.emplace_back(judge(c, outcome));
    if (!integrator.automatic) point.substeps = n;
    point.cpu_alone = 1e3 * outcome.timed.processor / solver_seconds / double(outcome.bodies.size());
  }
}

/// A point, and the times (ms) of its runs.
struct TimedPoint {
  const SolverScene& scene;
  const softbody::Integrator& integrator;
  WorkPoint& point;
  Timings alone{}, batch{};
};

void repeat(TimedPoint& p, SolverResults& results) {
  const auto time = [&](Timings& times, int copies) {
    if (times.total() <= 1e3 * results.effort.seconds) {  // the time of a long run depends less on chance
      const TimedParts timed = run_solver(p.scene, p.integrator, p.point.substeps, copies).timed;
      times.ms.push_back(1e3 * timed.processor);
      results.timed += timed;
    }
    return times.median() / solver_seconds / copies / double(p.scene.scene.bodies.size());
  };
  p.point.cpu_alone = time(p.alone, 1);
  if (!results.options.scene)  // copies of such a scene might touch
    p.point.cpu_batch = time(p.batch, softbody::lanes);
}

void measure(const std::vector<SolverScene>& scenes, SolverResults& results) {
  const SolverEffort& effort = results.effort;
  for (const SolverScene& scene : scenes) {
    const double progress = double(results.cases.size()) / double(scenes.size());
    say(scene.key + ": reference", progress);
    SolverCase& c = results.cases.emplace_back(begin_case(scene, effort.bound, effort.reference_steps));
    for (WorkCurve& curve : c.curves) {
      say(scene.key + ": " + std::string(curve.integrator->key), progress);
      find_errors(c, curve, effort);
    }
  }
  std::vector<TimedPoint> points;
  for (SolverCase& c : results.cases)
    for (WorkCurve& curve : c.curves)
      for (WorkPoint& p : curve.points)
        if (!p.blew_up) points.push_back({c.scene, *curve.integrator, p});
  // One repetition of all points after the other: what disturbs the machine for a while disturbs all alike.
  for (int r = 0; r < effort.repetitions; ++r)
    for (TimedPoint& point : points) {
      const double part = double(&point - points.data()) / double(points.size());
      say("repetition " + std::to_string(r + 1), (r + part) / effort.repetitions);
      repeat(point, results);
    }
}

std::vector<SolverScene> scenes_for(const ReportOptions& options) {
  if (options.scene) {
    const softbody::Scene scene = chosen_scenes(options).front();
    if (scene.bodies.empty()) throw UsageError("scene '" + scene.key + "': no body to measure; add a [[body]]");
    const auto joins = [](const softbody::BodySource& b) { return b.appear > 0 && b.appear <= solver_frames; };
    const auto starts = [](const softbody::BodySource& b) { return b.appear <= 0; };
    if (std::ranges::any_of(scene.bodies, joins) || std::ranges::none_of(scene.bodies, starts))
      throw UsageError("scene '" + scene.key + "': bodies join after the start; set appear = 0");
    return {{.key = scene.key, .name = scene.name, .scene = scene}};
  }
  std::vector<SolverScene> scenes = solver_scenes();
  if (options.quick)
    std::erase_if(scenes, [](const SolverScene& s) { return s.key.ends_with("1e6"); });  // the stiff ones
  return scenes;
}

}  // namespace

void report_solver(const ReportOptions& options) {
  const std::vector<SolverScene> scenes = scenes_for(options);
  files::prepare_folder(options.out);
  SolverResults results{.options = options};
  results.effort = options.quick ? SolverEffort{0.08, 2, 8'000} : SolverEffort{1, 3, 200'000};
  measure(scenes, results);
  if (!options.scene) {
    results.stiffness = measure_stiffness(options.quick);
    results.coarse = measure_coarse(options.quick);
  }
  write_report(options, solver_table(results), "solver.md", solver_page(results));
}

}  // namespace app::report
